#pragma once

namespace thermotwin::thermal {

/// Length that two intervals share [m]; never negative.
[[nodiscard]] double overlap(double low_a, double high_a, double low_b, double high_b);

/// Area of the disc x² + y² ≤ r² inside the rectangle [x0, x1] × [y0, y1], exact.
[[nodiscard]] double disc_in_rectangle(double r, double x0, double x1, double y0, double y1);

}  // namespace thermotwin::thermal
