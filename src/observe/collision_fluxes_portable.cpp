#define CAROM_INSTRUCTIONS portable
#include "observe/collision_fluxes_kernel.hpp"
