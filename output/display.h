#pragma once

namespace thermotwin::output {

/// Throws OutputError when no X server answers at DISPLAY: VTK would end the process without a word of use.
void expect_display();

}  // namespace thermotwin::output
