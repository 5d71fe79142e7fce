#define CAROM_INSTRUCTIONS avx512
#include "neighbours/cage_search_kernel.hpp"
