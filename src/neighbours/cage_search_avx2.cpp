#define CAROM_INSTRUCTIONS avx2
#include "neighbours/cage_search_kernel.hpp"
