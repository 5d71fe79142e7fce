#pragma once
// The words of the scene format and of other programs: which key belongs where, and the sentence for a word that is no key.

#include <span>
#include <string>
#include <string_view>

namespace carom::detail {

/// Returns the clause that names Carom's key for a word such as "dt", "nsteps" or "N"; empty where the word is not known.
std::string_view meant_by(std::string_view word);

/// Returns the key by which an override changes what `word` names in a scene: "disks.0.count" for "count". Empty where no table
/// has this key, or several have it.
std::string dotted_key_for(std::string_view word);

/// The number of single-character edits (a swap of neighbours counts as one) between two words, ignoring case.
std::size_t edit_distance(std::string_view a, std::string_view b);

/// Returns the candidate that is fewest edits away; empty when there is none within about a third of the word's length.
std::string_view nearest_word(std::string_view word, std::span<const std::string_view> candidates);

/// Returns text such as "[run]" for "run", "[[disks]]" for "disks.0", "the scene" for "", and the path itself for inline tables.
std::string table_title(std::string_view path);

/// Returns the sentence for a key that the table at `path` does not have: it names what other programs mean by it, the nearest
/// key of that table, or the table where a key of just this name belongs, or all keys of the table.
std::string unknown_key_sentence(std::string_view key, std::string_view path, std::span<const std::string_view> known);

}  // namespace carom::detail
