#define CAROM_INSTRUCTIONS avx2
#include "core/prediction_kernel.hpp"
