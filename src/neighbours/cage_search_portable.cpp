#define CAROM_INSTRUCTIONS portable
#include "neighbours/cage_search_kernel.hpp"
