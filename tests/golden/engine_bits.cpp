// Prints engine_bits(): compiled with a long double of another width, see CMakeLists.txt and long_double_test.cpp.

#include "golden/engine_bits.hpp"

#include <cstdio>

int main() { std::fputs(carom::test::engine_bits().c_str(), stdout); }
