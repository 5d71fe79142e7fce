// The line below the box.

#include "pages/drawing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <numbers>
#include <string>
#include <vector>

namespace carom::detail {

namespace {

double width_of(cairo_t* context, const std::string& text) {
  cairo_text_extents_t extents;
  cairo_text_extents(context, text.c_str(), &extents);
  return extents.x_advance;
}

void write(cairo_t* context, const std::string& text, double x, double y) {
  cairo_move_to(context, x, y);
  cairo_show_text(context, text.c_str());
}

/// The labels of the colour scale: its name, its beginning and its end.
struct Scale {
  std::string name, low, high;
};

Scale scale_of(const Subject& subject) {
  switch (subject.look.colouring) {
    case Colouring::speed:
      return {"speed", "0", fmt::format("{:.3g}", subject.ranges.fastest)};
    case Colouring::collisions:
      return {"collisions", "0", fmt::format("{:.0f}", subject.ranges.most_collisions)};
    case Colouring::id:
      return {"id", "0", fmt::format("{}", std::max<std::size_t>(1, subject.disks.count()) - 1)};
    case Colouring::psi6:
      return {"sixfold order |ψ6|", "0", "1"};
    case Colouring::psi6_angle:
      return {"axes of the sixfold order", "−30°", "30°"};
    default:
      return {};
  }
}

void draw_scale(cairo_t* context, const Subject& subject, double from, double right, double baseline) {
  const Scale scale = scale_of(subject);
  const double letters = subject.layout.letters, gap = 0.4 * letters, bar = 6.0 * letters;
  const std::string before = scale.name + "  " + scale.low;
  const double high = width_of(context, scale.high), low = width_of(context, before);
  const double begin = right - high - gap - bar;
  if (begin - gap - low < from) return;  // no room
  set_colour(context, theme(subject.look.dark).muted);
  write(context, scale.high, right - high, baseline);
  write(context, before, begin - gap - low, baseline);
  constexpr int steps = 64;
  cairo_pattern_t* shades = cairo_pattern_create_linear(begin, 0.0, begin + bar, 0.0);
  for (int k = 0; k <= steps; ++k) {
    const double share = static_cast<double>(k) / steps;
    const Colour colour = subject.look.colouring == Colouring::psi6_angle ? circle_colour(share - 0.5) : scale_colour(share);
    cairo_pattern_add_color_stop_rgb(shades, share, colour.red, colour.green, colour.blue);
  }
  cairo_rectangle(context, begin, baseline - 0.7 * letters, bar, 0.7 * letters);
  cairo_set_source(context, shades);
  cairo_fill(context);
  cairo_pattern_destroy(shades);
}

/// A colour and what it stands for.
struct Kind {
  std::string name;
  Colour colour;
};

std::vector<Kind> kinds_of(const Subject& subject) {
  std::vector<Kind> kinds;
  if (subject.look.colouring == Colouring::species) {
    for (std::size_t k = 0; k < subject.species_names.size(); ++k) kinds.push_back({subject.species_names[k], kind_colour(k)});
    return kinds;
  }
  for (std::size_t neighbours = 4; neighbours <= 8; ++neighbours)
    kinds.push_back({fmt::format("{}{}",
                                 neighbours == 4   ? "≤ "
                                 : neighbours == 8 ? "≥ "
                                                   : "",
                                 neighbours),
                     neighbours_colour(neighbours, subject.look.dark)});
  kinds.back().name += " neighbours";
  return kinds;
}

void draw_kinds(cairo_t* context, const Subject& subject, double from, double right, double baseline) {
  const double letters = subject.layout.letters, gap = 0.4 * letters, spot = 0.35 * letters;
  const std::vector<Kind> kinds = kinds_of(subject);
  double needed = -2.0 * gap;  // between two kinds
  for (const Kind& kind : kinds) needed += width_of(context, kind.name) + 2.0 * spot + 3.0 * gap;
  if (right - needed < from) return;  // no room
  double x = right;
  for (std::size_t k = kinds.size(); k-- > 0;) {
    x -= width_of(context, kinds[k].name);
    set_colour(context, theme(subject.look.dark).muted);
    write(context, kinds[k].name, x, baseline);
    x -= gap + spot;
    cairo_new_path(context);
    cairo_arc(context, x, baseline - spot, spot, 0.0, 2.0 * std::numbers::pi);
    set_colour(context, kinds[k].colour);
    cairo_fill(context);
    x -= spot + 2.0 * gap;
  }
}

}  // namespace

void draw_caption(cairo_t* context, const Subject& subject, const Moment& moment) {
  const Layout& at = subject.layout;
  cairo_select_font_face(context, "sans-serif", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(context, at.letters);
  const double baseline = at.caption_top + 1.1 * at.letters, left = at.size.width - at.caption_right;
  const std::string clock = "t = " + clock_text(moment.time, subject.ranges.clock);
  set_colour(context, theme(subject.look.dark).ink);
  write(context, clock, left, baseline);
  const double from = left + width_of(context, clock) + at.letters;
  if (subject.look.colouring == Colouring::species || subject.look.colouring == Colouring::neighbours) {
    draw_kinds(context, subject, from, at.caption_right, baseline);
  } else if (subject.look.colouring != Colouring::plain) {
    draw_scale(context, subject, from, at.caption_right, baseline);
  }
}

}  // namespace carom::detail
