#pragma once
// Changes of a run at given times as TOML text, and what they make of the effects of a scene.

#include <carom/changes.hpp>
#include <carom/scene.hpp>

#include <toml++/toml.h>

#include <cstddef>
#include <string>
#include <vector>

namespace carom {

/// Reads a list of changes, one [[changes]] table each, in order of time. `source` names the text in messages. Throws SceneError
/// with the place of what is wrong.
[[nodiscard]] std::vector<Change> parse_changes(const std::string& text, const std::string& source);
/// Reads the file of such a list. Throws SceneError, too where the file cannot be read.
[[nodiscard]] std::vector<Change> load_changes(const std::string& path);

/// Returns the change as its [[changes]] table, with a newline at the end. parse_changes() of the result gives the same change.
[[nodiscard]] std::string changes_text(const Change& change);

/// Returns what a change makes of the effects. What changes disks or velocities leaves them as they are. Throws SceneError where
/// a key is none of an effect, a value is wrong, or there is no such obstacle.
[[nodiscard]] Effects effects_after(const Effects& effects, const Change& change);

/// Throws SceneError where an override is of a key that a run has only at its start.
void require_changeable(const std::string& override_text, bool of_disks_too = true);

/// Returns what acts at a time of the measured run: what the scene begins with and all changes before that time have left.
[[nodiscard]] Effects effects_at(const Scene& scene, double time);

/// Returns the largest number of fixed shapes that the scene has at any time of its run.
[[nodiscard]] std::size_t most_fixed_shapes(const Scene& scene);

namespace detail {

/// Reads a list of tables, `node`, which is the value of `changes`. Where a table lacks its kind, the sentence names those that
/// change disks only if the list may have them, which one in a scene may not.
[[nodiscard]] std::vector<Change> read_changes(const toml::node& node, bool of_disks_too);

/// Returns the sentence for changes.K whose time comes before that of the change above it.
[[nodiscard]] std::string times_out_of_order(std::size_t k, double time, double before);

/// Returns effects of which each acts that acts in one of the two; the numbers are those of the first where it acts there.
[[nodiscard]] Effects merged(const Effects& one, const Effects& other);

/// Returns the effects of which any acts at some time of the scene's run, by merged().
[[nodiscard]] Effects effects_of_whole_run(const Scene& scene);

}  // namespace detail
}  // namespace carom
