// Turns a drawing into pixels and files.

#include "pages/painter.hpp"

#include "pages/drawing.hpp"
#include "pages/playback.hpp"
#include "pages/wall_vibrations.hpp"

#include <fmt/format.h>

#include <cairo-pdf.h>
#include <cairo-svg.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace carom {

namespace {

using detail::Context;
using detail::Surface;

cairo_status_t append(void* bytes, const unsigned char* data, unsigned int length) {
  static_cast<std::string*>(bytes)->append(reinterpret_cast<const char*>(data), length);
  return CAIRO_STATUS_SUCCESS;
}

void require_success(cairo_status_t status) {
  if (status == CAIRO_STATUS_NO_MEMORY) throw std::bad_alloc();
  if (status != CAIRO_STATUS_SUCCESS)
    throw std::runtime_error(fmt::format("the picture could not be drawn: {}", cairo_status_to_string(status)));
}

void draw(cairo_surface_t* surface, const detail::Subject& subject, const Moment& moment) {
  const Context context(cairo_create(surface));
  detail::draw_moment(context.get(), subject, moment);
  require_success(cairo_status(context.get()));
}

}  // namespace

Ranges ranges_of(Playback& playback, const Scene& scene, double from, double to) {
  constexpr int most_moments = 32;
  const int moments = to > from ? most_moments : 0;
  Ranges ranges;
  double typical = 0.0, fastest = 0.0;
  for (int k = 0; k <= moments; ++k) {
    const Moment& moment = playback.at(k == 0 ? from : std::min(to, from + (to - from) * k / moments));
    for (std::size_t side = 0; side < 4; ++side) {
      double& limit = ranges.extent[side];
      const double here = moment.sides[side];
      limit = k == 0 ? here : side % 2 == 0 ? std::min(limit, here) : std::max(limit, here);
    }
    const auto count = static_cast<double>(std::max<Eigen::Index>(1, moment.velocities.cols()));
    typical = std::max(typical, moment.velocities.norm() / std::sqrt(count));
    if (moment.velocities.cols() > 0) fastest = std::max(fastest, moment.velocities.colwise().norm().maxCoeff());
    for (const std::uint64_t collisions : moment.collisions)
      ranges.most_collisions = std::max(ranges.most_collisions, static_cast<double>(collisions));
  }
  if (to > from)
    for (const WallVibration& wall : wall_vibrations(scene)) {
      double& limit = ranges.extent[wall.side];
      limit = wall.side % 2 == 0 ? std::min(limit, wall.low) : std::max(limit, wall.high);
    }
  if (typical > 0.0) {
    ranges.typical_speed = typical;
    ranges.fastest = std::min(fastest, 2.5 * typical);  // of a gas in equilibrium, all but 2 in 1000
  }
  return ranges;
}

Painter::Painter(const Scene& scene, const Disks& disks, std::vector<std::string> species_names, const Look& look,
                 const Ranges& ranges, const PictureSize& size)
    : scene_(scene),
      disks_(disks),
      species_names_(std::move(species_names)),
      look_(look),
      ranges_(ranges),
      layout_(layout_of(ranges.extent, size, look.caption)) {}

std::vector<std::uint32_t> Painter::frame(const Moment& moment) const {
  const auto [width, height] = layout_.size;
  std::vector<std::uint32_t> pixels(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  const Surface surface(cairo_image_surface_create_for_data(reinterpret_cast<unsigned char*>(pixels.data()), CAIRO_FORMAT_RGB24,
                                                            width, height, 4 * width));
  draw(surface.get(), {scene_, disks_, species_names_, look_, ranges_, layout_}, moment);
  cairo_surface_flush(surface.get());
  return pixels;
}

std::string Painter::picture(const Moment& moment, PictureFormat format) const {
  const int width = layout_.size.width, height = layout_.size.height;
  std::string bytes;
  const auto make = [&] {
    if (format == PictureFormat::svg) return cairo_svg_surface_create_for_stream(append, &bytes, width, height);
    if (format == PictureFormat::pdf) return cairo_pdf_surface_create_for_stream(append, &bytes, width, height);
    return cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height);
  };
  const Surface surface(make());
  draw(surface.get(), {scene_, disks_, species_names_, look_, ranges_, layout_}, moment);
  if (format == PictureFormat::png) {
    require_success(cairo_surface_write_to_png_stream(surface.get(), append, &bytes));
  } else {
    cairo_surface_finish(surface.get());
  }
  require_success(cairo_surface_status(surface.get()));
  return bytes;
}

}  // namespace carom
