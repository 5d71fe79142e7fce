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
  /// The signal to send to child processes that are to stop too. Where SIGTERM came, to them as well perhaps, it is SIGINT: the
  /// second of one kind would end them at once. But where SIGINT is ignored here, it is ignored there.
  [[nodiscard]] int for_children() const;
};

}  // namespace carom::cli
