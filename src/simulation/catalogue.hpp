#pragma once
// The engines there are, and which of them runs a scene.

#include "simulation/any_engine.hpp"

#include <carom/scene.hpp>
#include <carom/state.hpp>

#include <memory>
#include <string>
#include <vector>

namespace carom::detail {

struct EngineEntry {
  std::string name;
  /// Why it cannot run the scene, in half a sentence; empty where it can.
  std::string (*why_not)(const Scene& scene, const Disks& disks);
  std::unique_ptr<AnyEngine> (*make)(const Scene& scene, const Disks& disks, State start);

  bool takes_rules = true;  ///< a program's own for collisions of pairs
  bool shares_out = false;  ///< runs on several cores where no effect keeps it on one
  bool keeps_spins = true;  ///< of disks that collisions do not turn

  [[nodiscard]] bool covers(const Scene& scene, const Disks& disks) const { return why_not(scene, disks).empty(); }
};

/// In the order in which they are considered: the first that covers a scene runs it.
const std::vector<EngineEntry>& catalogue();

/// What an engine has to do beyond what the scene says.
struct EngineNeeds {
  bool own_rule = false;  ///< of the program acts in collisions
  bool spins = false;     ///< has_spins()
};
/// Returns whether disks turn: a rough one keeps its spin where a change makes it smooth.
[[nodiscard]] bool has_spins(const Scene& scene, const State& state);

/// The named engine, or for "auto" the first of the catalogue that covers the scene. Throws std::invalid_argument where there is
/// no such engine, or it does not cover the scene.
const EngineEntry& choose_engine(const Scene& scene, const Disks& disks, const std::string& engine,
                                 const EngineNeeds& needs = {});

/// Why choose_engine() chose that entry, in half a sentence: for "auto", why the one before it could not run the scene.
std::string why_chosen(const EngineEntry& entry, const Scene& scene, const Disks& disks, const std::string& engine,
                       const EngineNeeds& needs = {});

/// An engine of that entry, driven from outside where the scene asks for it.
std::unique_ptr<AnyEngine> make_engine(const EngineEntry& entry, const Scene& scene, const Disks& disks, State start);

/// Returns why the fast engine does not cover a scene, in half a sentence; empty where it does.
std::string why_not_fast(const Scene& scene, const Disks& disks);
/// The fast engine, for equal disks or for any.
std::unique_ptr<AnyEngine> make_fast(const Scene& scene, const Disks& disks, State start);

/// Returns the same of the fast engine with every effect.
std::string why_not_general(const Scene& scene, const Disks& disks);
/// The fast engine with every effect.
std::unique_ptr<AnyEngine> make_general(const Scene& scene, const Disks& disks, State start);
/// The general engine for a mixture whose diameters are not additive.
std::unique_ptr<AnyEngine> make_mixed(const Scene& scene, const Disks& disks, State start);

/// The textbook engine in one number type; instantiated in textbook_<type>.cpp, one file each because they are slow to
/// compile.
template <class Real>
std::unique_ptr<AnyEngine> make_textbook(const Scene& scene, const Disks& disks, State start);

/// Returns what keeps disks with these effects on one core, in half a sentence; empty where nothing does.
[[nodiscard]] std::string why_not_threads(const Effects& effects, const Disks& disks);

}  // namespace carom::detail
