#define CAROM_INSTRUCTIONS avx2
#include "observe/collision_fluxes_kernel.hpp"
