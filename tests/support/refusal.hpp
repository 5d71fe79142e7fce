#pragma once
// What is said where something is refused.

#include <string>

namespace carom::test {

/// what() of the Error that `action` throws; empty where it throws nothing.
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
