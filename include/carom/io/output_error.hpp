#pragma once
// The exception that is thrown where a file cannot be written or read.

#include <stdexcept>

namespace carom {

/// A file of a run cannot be written or read. what() is one sentence: the path, the system's reason, what to do.
class OutputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace carom
