#pragma once
// Ctrl-C and SIGTERM while a scene runs: a request to stop at the next occasion, with the files completed.

namespace carom::cli {

/// From construction to destruction the first SIGINT or SIGTERM only sets a flag; the second ends the program at once. A
/// signal that the program was started to ignore (as by nohup) stays ignored.
class StopRequest {
 public:
  StopRequest();
  ~StopRequest();
  StopRequest(const StopRequest&) = delete;
  StopRequest& operator=(const StopRequest&) = delete;

  [[nodiscard]] bool made() const;
};

}  // namespace carom::cli
