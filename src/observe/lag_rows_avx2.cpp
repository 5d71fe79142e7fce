#define CAROM_INSTRUCTIONS avx2
#include "observe/lag_rows_kernel.hpp"
