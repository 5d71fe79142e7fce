#define CAROM_INSTRUCTIONS avx2
#include "observe/ended_flights_kernel.hpp"
