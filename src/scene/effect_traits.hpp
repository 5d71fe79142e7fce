#pragma once
// The table of effects: what checks, reports, observables and engines have to know of each, in one row. A rule that holds for
// several effects asks the table; only the file that carries an effect out, and the check of its numbers, name it.

#include "scene/number_keys.hpp"

#include <carom/effects.hpp>

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace carom::detail {

/// A number of an effect's table in a scene file: a key that must be there where the table is.
struct EffectNumber {
  const NumberKey* key;
  double (*value)(const Effects&);      ///< requires the effect to be present
  void (*set)(Effects&, double value);  ///< makes the effect present
  std::string_view unit;                ///< "1 / time"; empty for a pure number
  double neutral = 0.0;                 ///< with all numbers at these values the effect leaves the same bits
  double mild = 0.0;  ///< with all numbers at these values it acts without making another gas of one at sigma = m = kT = 1
};

/// The unit of numbers under a key with a reader of its own.
struct KeyUnit {
  std::string_view key;  ///< beginning of their names in the effect's table, entries of lists as #: "steps.#.energy"
  std::string_view unit;
};

/// Another effect with which one cannot act together. Where `at_neutral_value`, a scene may not even name both.
struct Exclusion {
  std::string_view other;  ///< EffectTraits::name
  bool at_neutral_value = false;
};

struct EffectTraits {
  std::string_view name;               ///< in Effects::acting() and names_of(), and the place at which it is refused
  std::string_view title;              ///< in error sentences: "[shear]", "a thermal wall"
  std::string_view absence = {};       ///< where it is absent, in `carom check`; empty where another row speaks for it
  bool (*is_present)(const Effects&);  ///< the scene names it
  bool (*acts)(const Effects&);        ///< the scene names it at another value than its neutral one, which leaves the same bits
  void (*take)(Effects& effects, const Effects& other) =
      nullptr;  ///< sets it as in `other`; null for those of walls, of which each side is by itself

  std::vector<EffectNumber> numbers = {};         ///< of the table [name], all of them required
  std::vector<std::string_view> other_keys = {};  ///< of that table, which have readers of their own
  std::vector<KeyUnit> units_of_other_keys = {};  ///< the first that fits is that of a number; those that none fits are pure
  std::string (*words)(const Effects&) =
      nullptr;  ///< what it does, with its numbers; null where the words on collision or walls contain it
  std::vector<Exclusion> excludes = {};  ///< effects with which it cannot be combined

  bool conserves_energy = true;  ///< conserves the energy of disks and pistons together
  bool (*conserves_energy_at_its_value)(const Effects&) =
      nullptr;  ///< conserves it all the same at the value that it has; null for an effect that does so at no value
  bool conserves_momentum = true;             ///< conserves the total momentum of the disks along a periodic axis
  bool thermalises_centre_of_mass = false;    ///< exchanges momentum at random: motion of the centre of mass is heat
  bool conserves_angular_momentum = true;     ///< of orbits and spins together, in collisions of disks
  bool has_potential_energy = false;          ///< energy may be stored otherwise than in motion
  bool has_energy_of_disk_positions = false;  ///< and how much of it depends on where the disks are
  bool keeps_speeds = false;                  ///< changes the directions of velocities alone
  bool only_varies_density = false;           ///< in equilibrium nothing but the density is other than without it: no velocity is
  bool runs_by_fixed_steps = false;           ///< src/stepper has it
  bool changes_radii = false;
  bool lets_temperature_fluctuate = false;  ///< kinetic energy is exchanged with a bath, spins or wells
  bool changes_velocities_in_flight =
      false;                          ///< between two logged events a velocity changes otherwise than by Effects::acceleration()
  bool bends_paths = false;           ///< the velocities before and after a collision do not tell where disks touched
  bool draws_random_numbers = false;  ///< while the run goes on

  double bytes_per_disk = 0.0;  ///< memory that it adds in the engine `general`, without fixed shapes, bonds and longer lists

  // Why something has no meaning where the effect acts; empty where it has one.
  std::string_view why_not_equilibrate = {};  ///< what to do instead: follows "[growth] and run.equilibrate cannot be combined; "
  std::string_view why_no_Z = {};             ///< the end of "no Z: ..."
  std::string_view why_no_replay = {};        ///< events do not tell the trajectory: a sentence without its stop
  std::string_view why_no_path = {};          ///< length of a flight as speed times time: speeds change between collisions
  std::string_view why_no_structure = {};     ///< correlations of positions: follows "observe.NAME"
  std::string_view why_no_displacements = {};  ///< of disks in a fluid at rest: follows "observe.NAME"
  std::string_view why_no_transport = {};      ///< Green-Kubo and Einstein-Helfand: follows "observe.NAME has no meaning here: "
};

/// All effects beyond the collision rule and hard walls, in the order of all lists that people read.
[[nodiscard]] const std::vector<EffectTraits>& all_effects();

/// The row of a name. Requires that there is one.
[[nodiscard]] const EffectTraits& effect_named(std::string_view name);

/// The first effect that acts and has a trait: `first_acting(effects, &EffectTraits::draws_random_numbers)`; null where none
/// does.
[[nodiscard]] const EffectTraits* first_acting(const Effects& effects, bool EffectTraits::*trait);
[[nodiscard]] inline bool any_acting(const Effects& effects, bool EffectTraits::*trait) {
  return first_acting(effects, trait) != nullptr;
}

/// The first effect that acts and does not go with run.equilibrate (why_not_equilibrate); null where none does.
[[nodiscard]] const EffectTraits* first_not_equilibrated(const Effects& effects);

/// Returns whether every effect that acts has a trait; true where none acts.
[[nodiscard]] bool all_acting(const Effects& effects, bool EffectTraits::*trait);

/// Returns whether a scene names an effect that has a trait, at whatever value.
[[nodiscard]] bool any_present(const Effects& effects, bool EffectTraits::*trait);

/// Sets all numbers of an effect's table: `set_numbers(effects, shear, &EffectNumber::mild)`. Requires that it has a table of
/// numbers.
void set_numbers(Effects& effects, const EffectTraits& effect, double EffectNumber::*value);

/// The sentence of the first effect that acts and has one; empty where none has. Effects with the trait `passed_over`, where one
/// is given, are not asked.
[[nodiscard]] std::string_view first_reason(const Effects& effects, std::string_view EffectTraits::*reason,
                                            bool EffectTraits::*passed_over = nullptr);

/// Returns whether no effect that acts, at the value that it has, gives or takes energy of disks and pistons.
[[nodiscard]] bool conserve_energy(const Effects& effects);

/// The titles of the effects whose table has a key, "[growth] or [shear]"; empty where none has.
[[nodiscard]] std::string tables_with_key(std::string_view key);

}  // namespace carom::detail
