#define CAROM_INSTRUCTIONS avx512
#include "core/prediction_kernel.hpp"
