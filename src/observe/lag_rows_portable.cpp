#define CAROM_INSTRUCTIONS portable
#include "observe/lag_rows_kernel.hpp"
