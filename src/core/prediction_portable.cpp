#define CAROM_INSTRUCTIONS portable
#include "core/prediction_kernel.hpp"
