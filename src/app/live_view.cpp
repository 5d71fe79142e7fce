#include "app/live_view.hpp"

#include "observe/energy.hpp"
#include "observe/equilibrium.hpp"
#include "observe/mechanics.hpp"
#include "observe/pressure.hpp"
#include "text/numbers.hpp"
#include "theory/microcanonical.hpp"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string_view>
#include <thread>

namespace carom::cli {

namespace {

using namespace std::chrono_literals;

constexpr auto shortest_interval = 100ms;
constexpr int share_of_time = 50;                 // one part in as many goes to drawing
constexpr int width_of_gauges = 30;               // characters, beside the picture
constexpr TextArea smallest_terminal = {60, 18};  // terminal

std::string_view environment(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? "" : value;
}

bool speaks_utf8() {
  for (const char* name : {"LC_ALL", "LC_CTYPE", "LANG"}) {
    const std::string_view value = environment(name);
    if (value.empty()) continue;
    return value.find("UTF-8") != value.npos || value.find("utf8") != value.npos || value.find("UTF8") != value.npos ||
           value.find("utf-8") != value.npos;
  }
  return false;
}

TextArea size_of_terminal() {
  winsize size{};
  if (ioctl(STDERR_FILENO, TIOCGWINSZ, &size) != 0) return {};
  return {size.ws_col, size.ws_row};
}

std::string plain(TerminalColours colours) { return colours == TerminalColours::none ? "" : "\x1b[39m"; }

/// Returns a horizontal bar to an eighth of a character, with a mark across it; a negative mark is not drawn.
std::string bar(double fraction, int width, double mark = -1.0) {
  static constexpr std::array<const char*, 9> parts = {" ", "▏", "▎", "▍", "▌", "▋", "▊", "▉", "█"};
  const auto eighths = std::lround(8.0 * width * std::clamp(fraction, 0.0, 1.0));
  const int marked = mark < 0.0 ? -1 : std::min(static_cast<int>(mark * width), width - 1);
  std::string text;
  for (int k = 0; k < width; ++k)
    text += k == marked ? "│" : parts[static_cast<std::size_t>(std::clamp(eighths - 8L * k, 0L, 8L))];
  return text;
}

/// Speeds in units of each disk's own sqrt(2 kT / m), against Maxwell and Boltzmann's law; one line per bin.
std::vector<std::string> speed_histogram(const Disks& disks, const State& state, double kT, TerminalColours colours) {
  constexpr std::size_t bins = 8;
  constexpr double bin = 0.3;
  constexpr int width = 18;
  std::array<double, bins> shares{};
  const auto columns = static_cast<double>(state.velocities.cols());
  for (Eigen::Index i = 0; i < state.velocities.cols(); ++i) {
    const double speed = state.velocities.col(i).norm() * std::sqrt(disks.mass[static_cast<std::size_t>(i)] / (2.0 * kT));
    if (const double at = speed / bin; at < static_cast<double>(bins)) shares[static_cast<std::size_t>(at)] += 1.0 / columns;
  }
  const auto expected = [](std::size_t b) {
    const double low = bin * static_cast<double>(b), high = low + bin;
    return theory::maxwell_speeds_below(high * high) - theory::maxwell_speeds_below(low * low);
  };
  const double full = 1.6 * expected(2);  // 0.6 to 0.9, where most disks are
  std::vector<std::string> lines = {"speed  (│ Maxwell-Boltzmann)"};
  for (std::size_t b = 0; b < bins; ++b) {
    const double middle = bin * (static_cast<double>(b) + 0.5);
    lines.push_back(fmt::format("{:4.2f} {}{}{}", middle, colour_sequence(theory::maxwell_speeds_below(middle * middle), colours),
                                bar(shares[b] / full, width, expected(b) / full), plain(colours)));
  }
  return lines;
}

}  // namespace

std::optional<TerminalColours> terminal_for_pictures() {
  if (isatty(STDERR_FILENO) != 1 || !speaks_utf8()) return std::nullopt;
  const std::string_view terminal = environment("TERM");
  if (terminal.empty() || terminal == "dumb") return std::nullopt;
  const TextArea size = size_of_terminal();
  if (size.columns < smallest_terminal.columns || size.rows < smallest_terminal.rows) return std::nullopt;
  if (!environment("NO_COLOR").empty()) return TerminalColours::none;  // https://no-color.org
  const std::string_view colours = environment("COLORTERM");
  return colours == "truecolor" || colours == "24bit" ? TerminalColours::all : TerminalColours::palette;
}

LiveView::LiveView(const Simulation& simulation, TerminalColours colours)
    : simulation_(simulation), colours_(colours), next_(Clock::now()), estimate_(simulation.scene()) {}

void LiveView::update(const Progress& progress) {
  if (Clock::now() >= next_) draw(progress);
}

void LiveView::keep_pace(double pace, const State& state, const Totals& totals) {
  if (!paced_since_) paced_since_ = Clock::now();
  constexpr double longest = 1e9;  // seconds: what a clock can count
  const std::chrono::duration<double> due(std::min(state.time / pace, longest));
  std::this_thread::sleep_until(*paced_since_ + std::chrono::duration_cast<Clock::duration>(due));
  update({.time = state.time, .totals = totals});
}

void LiveView::draw(const Progress& progress) {
  const Clock::time_point began = Clock::now();
  const TextArea terminal = size_of_terminal();
  if (terminal.columns < smallest_terminal.columns || terminal.rows < smallest_terminal.rows) return;  // it may grow again
  const State state = simulation_.state();
  const TextArea room = {terminal.columns - width_of_gauges - 2, terminal.rows - 1};
  std::vector<std::string> lines = terminal_picture(simulation_.scene(), simulation_.disks(), state, room, colours_);
  const std::vector<std::string> beside = gauges(progress, state, began);
  const std::string blank(static_cast<std::size_t>(room.columns), ' ');
  while (lines.size() < beside.size()) lines.push_back(blank);
  for (std::size_t k = 0; k < beside.size(); ++k) lines[k] += "  " + beside[k];
  put(lines, terminal);
  const Clock::time_point now = Clock::now();
  next_ = now + std::max<Clock::duration>(shortest_interval, share_of_time * (now - began));
}

std::vector<std::string> LiveView::gauges(const Progress& progress, const State& state, Clock::time_point now) {
  const Scene& scene = simulation_.scene();
  const Disks& disks = simulation_.disks();
  const RunEstimate::Estimate estimate = estimate_.at(progress, now);
  const double kT = kinetic_temperature(scene.box, scene.effects, disks, state);
  const double energy = energies_of(scene.box, scene.effects, disks, state, simulation_.whole_scene().box).total();
  if (!progress.equilibrating && !energy_at_start_) energy_at_start_ = energy;
  std::vector<std::string> lines = {
      fmt::format("time       {:.6g}{}", progress.time, progress.equilibrating ? " (equilibrating)" : ""),
      fmt::format("{} {:3.0f} %", bar(estimate.done, width_of_gauges - 7), 100.0 * estimate.done),
      fmt::format("left       {}", estimate.seconds_left && estimate.done < 1.0 ? duration(*estimate.seconds_left) : "-"),
      fmt::format("collisions {}", grouped(progress.totals.pair)),
      fmt::format("           {}", estimate.per_second > 0.0 ? rate(estimate.per_second) + "/s" : "-"),
      fmt::format("kT         {:.6g}", kT),
      fmt::format("energy     {:.6g}", energy),
      fmt::format("  changed  {}", energy_at_start_ && *energy_at_start_ != 0.0
                                       ? fmt::format("{:+.1e}", (energy - *energy_at_start_) / *energy_at_start_)
                                       : std::string("-"))};
  if (why_no_Z(scene).empty() && kT > 0.0 && progress.time > 0.0)
    lines.push_back(fmt::format("Z          {:.4f}",
                                compressibility(progress.totals.virial / progress.time, static_cast<double>(disks.count()), kT)));
  if (kT > 0.0 && std::isfinite(kT))
    for (std::string& line : speed_histogram(disks, state, kT, colours_)) lines.push_back(std::move(line));
  return lines;
}

/// Over the last picture, in one piece: half a picture is never seen.
void LiveView::put(const std::vector<std::string>& lines, TextArea terminal) {
  std::string text = drawn_ > 0 ? fmt::format("\x1b[{}A\r", drawn_) : std::string();
  const bool resized = terminal.columns != drawn_on_.columns || terminal.rows != drawn_on_.rows;
  if (resized) text += "\x1b[J";
  for (const std::string& line : lines) text += line + "\x1b[K\n";
  if (static_cast<int>(lines.size()) < drawn_) text += "\x1b[J";
  drawn_ = static_cast<int>(lines.size());
  drawn_on_ = terminal;
  std::fwrite(text.data(), 1, text.size(), stderr);
  std::fflush(stderr);
}

}  // namespace carom::cli
