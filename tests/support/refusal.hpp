#pragma once
// The sentence of a call that is refused.

#include <string>

namespace carom::test {

/// Returns what() of the Error that `action` throws; an empty text where it throws none.
template <class Error, class Action>
std::string refusal(Action&& action) {
  try {
    static_cast<void>(action());
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

}  // namespace carom::test
