// What is wrong with a name that is none of the numbers of a sweep, and which may have been meant.

#include "scene/excerpt.hpp"
#include "scene/known_keys.hpp"
#include "scene/observables_known.hpp"
#include "studies/sweep/number_name.hpp"
#include "studies/sweep/numbers.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace carom {

namespace {

std::string fault_of_observable(const std::string& name, const std::vector<std::string>& numbers) {
  const std::string observable = detail::observable_of(name);
  std::vector<std::string> own, all;
  for (const std::string& number : numbers) {
    if (!number.starts_with(detail::observables_prefix) || number.find("_error") != std::string::npos) continue;
    all.push_back(number);
    if (detail::observable_of(number) == observable) own.push_back(number);
  }
  if (!own.empty()) return fmt::format("no run has that number; of {} there are {}", observable, fmt::join(own, ", "));
  if (detail::find_observable(observable) == nullptr)
    return fmt::format("there is no observable \"{}\"; {}", detail::excerpt(observable, 40),
                       all.empty() ? "the scene's [observe] asks for none" : fmt::format("there are {}", fmt::join(all, ", ")));
  return fmt::format("no run has that number: the scene's [observe] does not ask for {}, or it makes tables alone{}", observable,
                     all.empty() ? "" : fmt::format("; there are {}", fmt::join(all, ", ")));
}

/// Returns the part of a name of `observable` that is its own, "Z" of "observables.pressure.Z", without what stands behind its @.
std::string_view own_part(std::string_view name, std::string_view observable) {
  const std::size_t begin = std::min(name.size(), detail::observables_prefix.size() + observable.size() + 1);
  return name.substr(begin, name.find('@', begin) - begin);
}

/// Returns what may have been meant by a name of an observable or of a table that there is: a number or a column that begins as
/// its own part does or is near to it; empty where none is.
std::string meant_in_observable(const std::string& name, const std::vector<std::string>& numbers) {
  const std::string observable = detail::observable_of(name);
  const std::size_t sign = name.find('@');
  std::vector<const std::string*> all;
  std::vector<std::string_view> words;
  for (const std::string& number : numbers) {
    const bool of_a_table = number.find('@') != std::string::npos;
    if (!number.starts_with(detail::observables_prefix) || detail::observable_of(number) != observable ||
        (sign != std::string::npos && !of_a_table))
      continue;
    all.push_back(&number);
    words.push_back(own_part(number, observable));
  }
  const std::string_view own = own_part(name, observable);
  if (own.empty() || detail::is_place(own)) return {};
  auto found = std::ranges::find_if(words, [&](std::string_view word) { return word.starts_with(own); });
  if (found == words.end()) found = std::ranges::find(words, detail::nearest_word(own, words));
  if (found == words.end()) return {};
  const std::string& meant = *all[static_cast<std::size_t>(found - words.begin())];
  return sign == std::string::npos ? meant : meant.substr(0, meant.find('@')) + name.substr(sign);
}

/// Returns the number or the column that is few edits away from a name, whatever observable that is of.
std::string meant_anywhere(const std::string& name, const std::vector<std::string>& numbers) {
  constexpr std::size_t most_edits = 3;  // names of observables are long, and a third of one is another
  const std::size_t sign = name.find('@');
  std::vector<std::string_view> words;
  for (const std::string_view number : numbers)
    if (number.starts_with(detail::observables_prefix) &&
        (sign == std::string::npos || number.find('@') != std::string_view::npos))
      words.push_back(number.substr(0, number.find('@')));
  const std::string_view whole = std::string_view(name).substr(0, sign);
  const std::string_view near = detail::nearest_word(whole, words);
  if (near.empty() || detail::edit_distance(whole, near) > most_edits) return {};
  return std::string(near) + (sign == std::string::npos ? "" : name.substr(sign));
}

std::string did_you_mean(std::string_view name) { return fmt::format("no run has that number; did you mean \"{}\"?", name); }

/// Returns what is wrong with the values behind the @ of a column that there is; nothing where there is none of that name.
std::optional<std::string> fault_of_place(const std::string& name, const std::vector<std::string>& numbers) {
  const std::size_t sign = name.find('@');
  if (sign == std::string::npos) return {};
  const auto form = std::ranges::find_if(numbers, [&](const std::string& number) {
    return number.size() > sign && number[sign] == '@' && number.compare(0, sign, name, 0, sign) == 0;
  });
  if (form == numbers.end()) return {};
  const std::string columns = form->substr(sign + 1);
  const std::size_t count = split_at_commas(columns).size();
  const std::optional<TableNumber> wanted = table_number(name);
  if (!wanted || wanted->at.size() != count)
    return fmt::format("behind @ there is to be a value of {}, such as {}{}", columns, form->substr(0, sign + 1),
                       fmt::join(std::vector<double>(count, 1.5), ","));
  if (columns == "lag" && wanted->at.front() <= 0.0) return "no run has a row there; the table begins at a larger lag";
  if (columns == "lag") return "no run is that long; a lag is at most run.time";
  if (std::ranges::find(detail::counting_columns, columns) != detail::counting_columns.end() &&
      wanted->at.front() != std::floor(wanted->at.front()))
    return fmt::format("{} is a whole number", columns);
  if (count == 1 && !detail::is_place(columns))
    return fmt::format("no run has a row there; the table begins at a larger {0}, or ends at a smaller", columns);
  if (columns == "x" || columns == "y")
    return fmt::format("no run has a row there; rows are at the {} of the middles of cells", columns);
  return "no run has a row there; a place is in the box, and a time at most run.time";
}

/// Returns which columns there are in the table of a name with @; nothing where no table is called so.
std::optional<std::string> fault_of_column(const std::string& name, const std::vector<std::string>& numbers) {
  const std::string table = detail::observable_of(name);
  std::string places;
  std::vector<std::string_view> columns;
  for (const std::string& number : numbers) {
    const std::size_t sign = number.find('@');
    if (sign == std::string::npos || detail::observable_of(number) != table) continue;
    places = number.substr(sign + 1);
    if (const std::string_view column = own_part(number, table); !column.ends_with("_error")) columns.push_back(column);
  }
  if (name.find('@') == std::string::npos || columns.empty()) return {};
  const std::string_view own = own_part(name, table);
  const std::string which = detail::excerpt(own, 40);
  const std::string beginning =
      detail::is_place(own) ? fmt::format("the column \"{}\" of the table {} says which row it is; its others", which, table)
                            : fmt::format("no column \"{}\" is in the table {}; its columns", which, table);
  return fmt::format("{}, each at a value of {}, are {}", beginning, places, fmt::join(columns, ", "));
}

std::string fault_of_observed_number(const std::string& name, const std::vector<std::string>& numbers) {
  if (const std::optional<std::string> fault = fault_of_place(name, numbers)) return *fault;
  const std::string of_observable = meant_in_observable(name, numbers);
  const std::string meant = of_observable.empty() ? meant_anywhere(name, numbers) : of_observable;
  const bool is_another_column =
      of_observable.empty() && meant.starts_with(fmt::format("{}{}.", detail::observables_prefix, detail::observable_of(name)));
  if (!meant.empty() && !is_another_column) return did_you_mean(meant);
  const std::optional<std::string> fault = fault_of_column(name, numbers);
  return fault ? *fault : fault_of_observable(name, numbers);
}

}  // namespace

std::string fault_of_number_name(const std::string& name, const std::vector<std::string>& numbers) {
  if (name.starts_with(detail::observables_prefix)) return fault_of_observed_number(name, numbers);
  const std::string observed = std::string(detail::observables_prefix) + name;
  const std::string form = observed.substr(0, observed.find('@'));
  for (const std::string& number : numbers)
    if (number == observed || number.substr(0, number.find('@')) == form)
      return did_you_mean(form == observed ? number : observed);
  std::vector<std::string_view> words;
  std::ranges::copy_if(numbers, std::back_inserter(words),
                       [](const std::string& number) { return !number.starts_with(detail::observables_prefix); });
  if (const std::string_view near = detail::nearest_word(name, words); !near.empty()) return did_you_mean(near);
  if (std::ranges::any_of(numbers, [&](const std::string& number) {
        return number.starts_with(detail::observables_prefix) && detail::observable_of(number) == detail::observable_of(observed);
      }))
    return fault_of_observed_number(observed, numbers);
  std::erase_if(words, [](std::string_view number) { return number.find("_error") != std::string_view::npos; });
  const bool observes =
      std::ranges::any_of(numbers, [](const std::string& number) { return number.starts_with(detail::observables_prefix); });
  return fmt::format("no run has that number; there are {}{}", fmt::join(words, ", "),
                     observes ? ", and those of observables, such as \"observables.pressure.Z\"" : "");
}

}  // namespace carom
