#include "thermal/sundials_vector.h"

#include <cmath>

#include "thermal/fixed_blocks.h"

namespace thermotwin::thermal {
namespace {

void linear_sum(realtype a, N_Vector first, realtype b, N_Vector second, N_Vector sum) {
  double const *x = data(first), *y = data(second);
  double* z = data(sum);
  for_terms(NV_LENGTH_S(sum), [=](std::ptrdiff_t i) { z[i] = a * x[i] + b * y[i]; });
}

void fill(realtype value, N_Vector v) {
  double* z = data(v);
  for_terms(NV_LENGTH_S(v), [=](std::ptrdiff_t i) { z[i] = value; });
}

void scale(realtype factor, N_Vector from, N_Vector to) {
  double const* x = data(from);
  double* z = data(to);
  for_terms(NV_LENGTH_S(to), [=](std::ptrdiff_t i) { z[i] = factor * x[i]; });
}

/// The first of the added vectors is the sum's own place where they are the same.
int linear_combination(int count, realtype* factors, N_Vector* vectors, N_Vector result) {
  double* z = data(result);
  for_blocks(NV_LENGTH_S(result), [=](std::ptrdiff_t begin, std::ptrdiff_t end) {
    double const* x = data(vectors[0]);
#pragma omp simd
    for (auto i = begin; i < end; ++i) z[i] = factors[0] * x[i];
    for (int k = 1; k < count; ++k) {
      double const* y = data(vectors[k]);
      double const factor = factors[k];
#pragma omp simd
      for (auto i = begin; i < end; ++i) z[i] += factor * y[i];
    }
  });
  return 0;
}

int scale_add_multi(int count, realtype* factors, N_Vector added, N_Vector* to, N_Vector* results) {
  double const* x = data(added);
  for_blocks(NV_LENGTH_S(added), [=](std::ptrdiff_t begin, std::ptrdiff_t end) {
    for (int k = 0; k < count; ++k) {
      double const* y = data(to[k]);
      double* z = data(results[k]);
      double const factor = factors[k];
#pragma omp simd
      for (auto i = begin; i < end; ++i) z[i] = factor * x[i] + y[i];
    }
  });
  return 0;
}

realtype weighted_norm(N_Vector v, N_Vector weights) {
  double const *x = data(v), *w = data(weights);
  double const sum = sum_of_terms(NV_LENGTH_S(v), [=](std::ptrdiff_t i) { return x[i] * w[i] * (x[i] * w[i]); });
  return std::sqrt(sum / double(NV_LENGTH_S(v)));
}

}  // namespace

N_Vector make_vector(sunindextype length, SUNContext context) {
  N_Vector v = N_VNew_Serial(length, context);
  v->ops->nvlinearsum = linear_sum;
  v->ops->nvconst = fill;
  v->ops->nvscale = scale;
  v->ops->nvlinearcombination = linear_combination;
  v->ops->nvscaleaddmulti = scale_add_multi;
  v->ops->nvwrmsnorm = weighted_norm;
  return v;
}

}  // namespace thermotwin::thermal
