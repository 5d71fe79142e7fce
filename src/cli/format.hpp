#pragma once
// Numbers and names as a person reads them: pages of results have the same words.

#include "show/number_words.hpp"
