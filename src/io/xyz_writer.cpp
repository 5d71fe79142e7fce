// Samples as extended XYZ.

#include "io/xyz_writer.hpp"

#include "observe/geometry.hpp"

#include <fmt/format.h>

#include <array>
#include <iterator>
#include <map>
#include <utility>

namespace carom {

namespace {

constexpr std::array<std::string_view, 118> symbols = {
    "H",  "He", "Li", "Be", "B",  "C",  "N",  "O",  "F",  "Ne", "Na", "Mg", "Al", "Si", "P",  "S",  "Cl", "Ar", "K",  "Ca",
    "Sc", "Ti", "V",  "Cr", "Mn", "Fe", "Co", "Ni", "Cu", "Zn", "Ga", "Ge", "As", "Se", "Br", "Kr", "Rb", "Sr", "Y",  "Zr",
    "Nb", "Mo", "Tc", "Ru", "Rh", "Pd", "Ag", "Cd", "In", "Sn", "Sb", "Te", "I",  "Xe", "Cs", "Ba", "La", "Ce", "Pr", "Nd",
    "Pm", "Sm", "Eu", "Gd", "Tb", "Dy", "Ho", "Er", "Tm", "Yb", "Lu", "Hf", "Ta", "W",  "Re", "Os", "Ir", "Pt", "Au", "Hg",
    "Tl", "Pb", "Bi", "Po", "At", "Rn", "Fr", "Ra", "Ac", "Th", "Pa", "U",  "Np", "Pu", "Am", "Cm", "Bk", "Cf", "Es", "Fm",
    "Md", "No", "Lr", "Rf", "Db", "Sg", "Bh", "Hs", "Mt", "Ds", "Rg", "Cn", "Nh", "Fl", "Mc", "Lv", "Ts", "Og"};

}  // namespace

std::string_view chemical_symbol(std::int32_t species) { return symbols[static_cast<std::size_t>(species) % symbols.size()]; }

XyzWriter::XyzWriter(std::filesystem::path path, const Scene& scene, const Disks& disks, std::optional<std::uint64_t> kept)
    : file_(kept ? detail::TextFile(std::move(path), *kept) : detail::TextFile(std::move(path))),
      box_(scene.box),
      diameter_(largest_diameter(disks, State{})),
      species_(disks.species) {
  std::map<std::pair<double, double>, std::size_t> known;
  tail_.reserve(disks.count());
  for (std::size_t i = 0; i < disks.count(); ++i) {
    const auto [entry, is_new] = known.try_emplace({disks.radius[i], disks.mass[i]}, kinds_.size());
    if (is_new) kinds_.push_back({disks.radius[i], disks.mass[i]});
    tail_.push_back(entry->second);
  }
  describe_box(State{});
  describe_kinds(1.0);
}

void XyzWriter::describe_box(const State& state) {
  const Box now = box_of(box_, state);
  const double thickness = diameter_ * state.scale;
  displacement_ = state.shear_displacement;
  head_ = fmt::format(
      "{}\nLattice=\"{} 0 0 {} {} 0 0 0 {}\" Origin=\"{} {} {}\" pbc=\"{} {} F\" "
      "Properties=species:S:1:pos:R:3:velo:R:3:radius:R:1:mass:R:1:id:I:1 Time=",
      species_.size(), now.lengths().x(), tilt_of(now.lengths(), state), now.lengths().y(), thickness, now.lower.x(),
      now.lower.y(), -0.5 * thickness, box_.periodic(0) ? 'T' : 'F', box_.periodic(1) ? 'T' : 'F');
}

// Formatting radius and mass anew for every disk and sample would take a third of the time.
void XyzWriter::describe_kinds(double scale) {
  tails_.clear();
  for (const Kind& kind : kinds_) tails_.push_back(fmt::format(" 0 {} {} ", scale * kind.radius, kind.mass));
  tails_scale_ = scale;
}

void XyzWriter::sample(const State& state) {
  const auto out = [this] { return std::back_inserter(file_.buffer()); };
  if (!state.walls.empty() || state.scale != tails_scale_ || state.shear_displacement != displacement_) describe_box(state);
  if (state.scale != tails_scale_) describe_kinds(state.scale);
  fmt::format_to(out(), "{}{}\n", head_, state.time);
  for (Eigen::Index i = 0; i < state.positions.cols(); ++i) {
    const auto disk = static_cast<std::size_t>(i);
    fmt::format_to(out(), "{} {} {} 0 {} {}{}{}\n", chemical_symbol(species_[disk]), state.positions(0, i), state.positions(1, i),
                   state.velocities(0, i), state.velocities(1, i), tails_[tail_[disk]], i);
    file_.end_line();
  }
  file_.end_record();
}

}  // namespace carom
