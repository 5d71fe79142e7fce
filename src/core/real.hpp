#pragma once
// The number types that an engine can compute with, from 24 to 113 bits of significand.

#include <Eigen/Core>

#if CAROM_HAS_QUADMATH
#include <boost/multiprecision/float128.hpp>
#else
#include <boost/multiprecision/cpp_bin_float.hpp>
#endif
#include <boost/multiprecision/eigen.hpp>

#include <cmath>
#include <limits>

namespace carom {

/// IEEE binary128: 113 bits. In hardware-assisted software (libquadmath) where there is one, portable otherwise; both
/// round correctly, so the bits are the same.
#if CAROM_HAS_QUADMATH
using Quad = boost::multiprecision::float128;
#else
using Quad = boost::multiprecision::cpp_bin_float_quad;
#endif

template <class Real>
inline constexpr Real infinity = std::numeric_limits<Real>::infinity();

/// Unit in the last place of 1: twice the largest relative error of one rounded operation.
template <class Real>
inline constexpr Real epsilon = std::numeric_limits<Real>::epsilon();

}  // namespace carom
