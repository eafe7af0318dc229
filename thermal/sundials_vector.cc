#include "thermal/sundials_vector.h"

#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <nvector/nvector_serial.h>
#include <vector>

#include "thermal/fixed_blocks.h"

namespace thermotwin::thermal {
namespace {

/// What long vectors of one length were asked for, in this order, and have not done yet.
using LateWork = std::vector<std::function<void(std::ptrdiff_t begin, std::ptrdiff_t end)>>;

struct Content : _N_VectorContent_Serial {
  std::unique_ptr<double[]> values;
  std::shared_ptr<LateWork> late;  ///< of all clones; none of short vectors
};

Content& content(N_Vector v) { return static_cast<Content&>(*NV_CONTENT_S(v)); }

void catch_up(Content const& vector) {
  if (!vector.late || vector.late->empty()) return;
  for_blocks(vector.length, [&](std::ptrdiff_t begin, std::ptrdiff_t end) {
    for (auto const& work : *vector.late) work(begin, end);
  });
  vector.late->clear();
}

/// Now or late.
template <class Work>
void on_blocks(N_Vector v, Work const& work) {
  if (auto const& own = content(v); own.late)
    own.late->emplace_back(work);
  else
    for_blocks(own.length, work);
}

template <class Term>
void on_terms(N_Vector v, Term const& term) {
  on_blocks(v, [term](std::ptrdiff_t begin, std::ptrdiff_t end) {
#pragma omp simd
    for (auto i = begin; i < end; ++i) term(i);
  });
}

void linear_sum(realtype a, N_Vector first, realtype b, N_Vector second, N_Vector sum) {
  on_terms(sum, [a, b, x = NV_DATA_S(first), y = NV_DATA_S(second), z = NV_DATA_S(sum)](std::ptrdiff_t i) {
    z[i] = a * x[i] + b * y[i];
  });
}

void fill(realtype value, N_Vector v) {
  on_terms(v, [value, z = NV_DATA_S(v)](std::ptrdiff_t i) { z[i] = value; });
}

void scale(realtype factor, N_Vector from, N_Vector to) {
  on_terms(to, [factor, x = NV_DATA_S(from), z = NV_DATA_S(to)](std::ptrdiff_t i) { z[i] = factor * x[i]; });
}

/// The first of the added vectors is the sum's own place where they are the same.
int linear_combination(int count, realtype* factors, N_Vector* vectors, N_Vector result) {
  struct Term {
    double factor;
    double const* x;
  };
  std::array<Term, 8> terms;  // CVODES adds up no more than its history, six vectors
  if (count > int(terms.size())) return -1;
  for (int k = 0; k < count; ++k) terms[std::size_t(k)] = {factors[k], NV_DATA_S(vectors[k])};
  on_blocks(result, [count, terms, z = NV_DATA_S(result)](std::ptrdiff_t begin, std::ptrdiff_t end) {
    auto const [first, x] = terms[0];
#pragma omp simd
    for (auto i = begin; i < end; ++i) z[i] = first * x[i];
    for (int k = 1; k < count; ++k) {
      auto const [factor, y] = terms[std::size_t(k)];
#pragma omp simd
      for (auto i = begin; i < end; ++i) z[i] += factor * y[i];
    }
  });
  return 0;
}

int scale_add_multi(int count, realtype* factors, N_Vector added, N_Vector* to, N_Vector* results) {
  for (int k = 0; k < count; ++k)
    on_terms(results[k], [factor = factors[k], x = NV_DATA_S(added), y = NV_DATA_S(to[k]),
                          z = NV_DATA_S(results[k])](std::ptrdiff_t i) { z[i] = factor * x[i] + y[i]; });
  return 0;
}

realtype weighted_norm(N_Vector v, N_Vector weights) {
  auto const& own = content(v);
  double const *x = own.data, *w = NV_DATA_S(weights);
  double const sum = sum_of_blocks(own.length, [&](std::ptrdiff_t begin, std::ptrdiff_t end) {
    if (own.late)
      for (auto const& work : *own.late) work(begin, end);
    return sum_within(begin, end, [=](std::ptrdiff_t i) { return x[i] * w[i] * (x[i] * w[i]); });
  });
  if (own.late) own.late->clear();
  return std::sqrt(sum / double(own.length));
}

void hold(N_Vector v, sunindextype length, std::shared_ptr<LateWork> late) {
  auto* own = new Content{
      {length, SUNFALSE, nullptr}, std::make_unique_for_overwrite<double[]>(std::size_t(length)), std::move(late)};
  own->data = own->values.get();
  v->content = static_cast<_N_VectorContent_Serial*>(own);
}

N_Vector clone(N_Vector from) {
  N_Vector v = N_VNewEmpty(from->sunctx);
  N_VCopyOps(from, v);
  hold(v, content(from).length, content(from).late);
  return v;
}

/// What its memory is still asked for would be done to another's.
void destroy(N_Vector v) {
  catch_up(content(v));
  delete &content(v);
  N_VFreeEmpty(v);
}

}  // namespace

double* data(N_Vector v) {
  auto const& own = content(v);
  catch_up(own);
  return own.data;
}

N_Vector make_vector(sunindextype length, SUNContext context) {
  N_Vector serial = N_VNewEmpty_Serial(length, context), v = N_VNewEmpty(context);
  N_VCopyOps(serial, v);
  N_VDestroy(serial);
  v->ops->nvclone = clone;
  v->ops->nvdestroy = destroy;
  v->ops->nvgetarraypointer = data;
  v->ops->nvlinearsum = linear_sum;
  v->ops->nvconst = fill;
  v->ops->nvscale = scale;
  v->ops->nvlinearcombination = linear_combination;
  v->ops->nvscaleaddmulti = scale_add_multi;
  v->ops->nvwrmsnorm = weighted_norm;
  hold(v, length, length < worth_a_thread ? nullptr : std::make_shared<LateWork>());
  return v;
}

}  // namespace thermotwin::thermal
