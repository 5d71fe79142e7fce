#define CAROM_INSTRUCTIONS portable
#include "observe/ended_flights_kernel.hpp"
