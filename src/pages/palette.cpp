#include "pages/palette.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace carom {

namespace {

constexpr Colour of(std::uint32_t rgb) {
  return {static_cast<double>(rgb >> 16U) / 255.0, static_cast<double>(rgb >> 8U & 0xffU) / 255.0,
          static_cast<double>(rgb & 0xffU) / 255.0};
}

constexpr std::array viridis = {of(0x440154), of(0x472d7b), of(0x3b528b), of(0x2c728e), of(0x21918c),
                                of(0x28ae80), of(0x5ec962), of(0xaddc30), of(0xfde725)};
constexpr std::array kinds = {of(0x0072b2), of(0xe69f00), of(0x009e73), of(0xcc79a7),
                              of(0x56b4e9), of(0xd55e00), of(0xf0e442), of(0x8c8c8c)};

constexpr Theme light = {.paper = of(0xffffff),
                         .stage = of(0xfbfcfd),
                         .ink = of(0x1b2330),
                         .muted = of(0x5c6675),
                         .frame = of(0xaeb6c1),
                         .solid = of(0x6b7584),
                         .accent = of(0x0b62a4),
                         .plain = of(0x4c8fc7),
                         .rim = of(0x000000)};
constexpr Theme dark_theme = {.paper = of(0x12161c),
                              .stage = of(0x171c24),
                              .ink = of(0xe6eaf0),
                              .muted = of(0x98a3b3),
                              .frame = of(0x55606e),
                              .solid = of(0x8a95a5),
                              .accent = of(0x6cb6f0),
                              .plain = of(0x4c8fc7),
                              .rim = of(0xffffff)};

}  // namespace

Colour scale_colour(double share) {
  if (!(share > 0.0)) return viridis.front();
  const double at = std::min(share, 1.0) * (viridis.size() - 1);
  const std::size_t low = std::min(static_cast<std::size_t>(at), viridis.size() - 2);
  const Colour &a = viridis[low], &b = viridis[low + 1];
  const double part = at - static_cast<double>(low);
  return {std::lerp(a.red, b.red, part), std::lerp(a.green, b.green, part), std::lerp(a.blue, b.blue, part)};
}

Colour circle_colour(double share) {
  const auto part = [&](double begin) { return 0.55 + 0.4 * std::cos(2.0 * std::numbers::pi * (share - begin)); };
  return {part(0.0), part(1.0 / 3.0), part(2.0 / 3.0)};
}

Colour neighbours_colour(std::size_t neighbours, bool dark) {
  if (neighbours == 6) return dark ? of(0x39424e) : of(0xd5dae0);
  if (neighbours == 5) return kinds[5];
  if (neighbours == 7) return kinds[0];
  return neighbours < 5 ? kinds[1] : kinds[2];
}

Colour kind_colour(std::size_t kind) { return kinds[kind % kinds.size()]; }

const Theme& theme(bool dark) { return dark ? dark_theme : light; }

}  // namespace carom
