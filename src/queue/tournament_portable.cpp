#define CAROM_INSTRUCTIONS portable
#include "queue/tournament_kernel.hpp"
