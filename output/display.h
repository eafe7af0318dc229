#pragma once

namespace thermotwin::output {

/// A connection to the X server that DISPLAY names, as long as this lives. OutputError, with the way out, where there
/// is none: VTK would end the whole program.
///
/// An X server without a guest (Xvfb) starts anew when the last one leaves, and meanwhile refuses others. So whoever
/// draws holds one of these from before VTK connects until it is done, and a refusal is asked again for half a second.
class DisplayConnection {
 public:
  DisplayConnection();
  ~DisplayConnection();
  DisplayConnection(DisplayConnection const&) = delete;
  DisplayConnection& operator=(DisplayConnection const&) = delete;

 private:
  void* library_;
  void* connection_ = nullptr;
};

}  // namespace thermotwin::output
