// fmt and toml++, compiled for the static program: Debian has a shared library of each, and headers that one file may compile in
// its place.

#include <fmt/format-inl.h>

#define TOML_HEADER_ONLY 0
#define TOML_IMPLEMENTATION
#include <toml++/toml.h>

// The templates that fmt's headers declare and only its library has.
template auto fmt::detail::thousands_sep_impl<char>(locale_ref) -> thousands_sep_result<char>;
template auto fmt::detail::decimal_point_impl<char>(locale_ref) -> char;
