#include "thermal/sundials_vector.h"

#include <array>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <memory>
#include <vector>

#include "thermal/fixed_blocks.h"

namespace thermotwin::thermal {
namespace {

/// What long vectors of one length were asked for, in this order, and have not done yet.
using LateWork = std::vector<std::function<void(std::ptrdiff_t begin, std::ptrdiff_t end)>>;

struct Content {
  std::ptrdiff_t length;
  std::shared_ptr<LateWork> late;  ///< of all clones; none of short vectors
  std::unique_ptr<double[]> values = std::make_unique_for_overwrite<double[]>(std::size_t(length));

  void do_late_work(std::ptrdiff_t begin, std::ptrdiff_t end) const {
    if (late)
      for (auto const& work : *late) work(begin, end);
  }
  void catch_up() const {
    if (!late || late->empty()) return;
    for_blocks(length, [this](std::ptrdiff_t begin, std::ptrdiff_t end) { do_late_work(begin, end); });
    late->clear();
  }
};

Content& content(N_Vector v) { return *static_cast<Content*>(v->content); }
/// As they are now.
double* values(N_Vector v) { return content(v).values.get(); }

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
  on_blocks(v, [term](std::ptrdiff_t begin, std::ptrdiff_t end) { for_terms_within(begin, end, term); });
}

void linear_sum(realtype a, N_Vector first, realtype b, N_Vector second, N_Vector sum) {
  on_terms(sum, [a, b, x = values(first), y = values(second), z = values(sum)](std::ptrdiff_t i) {
    z[i] = a * x[i] + b * y[i];
  });
}

void fill(realtype value, N_Vector v) {
  on_terms(v, [value, z = values(v)](std::ptrdiff_t i) { z[i] = value; });
}

void scale(realtype factor, N_Vector from, N_Vector to) {
  on_terms(to, [factor, x = values(from), z = values(to)](std::ptrdiff_t i) { z[i] = factor * x[i]; });
}

/// The first of the added vectors is the sum's own place where they are the same.
int linear_combination(int count, realtype* factors, N_Vector* vectors, N_Vector result) {
  struct Term {
    double factor = 0.0;
    double const* x = nullptr;
  };
  std::array<Term, 8> terms;  // CVODES adds up no more than its history, six vectors
  if (count > int(terms.size())) return -1;
  for (int k = 0; k < count; ++k) terms[std::size_t(k)] = {factors[k], values(vectors[k])};
  on_blocks(result, [count, terms, z = values(result)](std::ptrdiff_t begin, std::ptrdiff_t end) {
    double const first = terms[0].factor, *const x = terms[0].x;
    for_terms_within(begin, end, [=](std::ptrdiff_t i) { z[i] = first * x[i]; });
    for (int k = 1; k < count; ++k) {
      double const factor = terms[std::size_t(k)].factor, *const y = terms[std::size_t(k)].x;
      for_terms_within(begin, end, [=](std::ptrdiff_t i) { z[i] += factor * y[i]; });
    }
  });
  return 0;
}

int scale_add_multi(int count, realtype* factors, N_Vector added, N_Vector* to, N_Vector* results) {
  for (int k = 0; k < count; ++k)
    on_terms(results[k], [factor = factors[k], x = values(added), y = values(to[k]),
                          z = values(results[k])](std::ptrdiff_t i) { z[i] = factor * x[i] + y[i]; });
  return 0;
}

realtype weighted_norm(N_Vector v, N_Vector weights) {
  auto const& own = content(v);
  double const *x = values(v), *w = values(weights);
  double const sum = sum_of_blocks(own.length, [&](std::ptrdiff_t begin, std::ptrdiff_t end) {
    own.do_late_work(begin, end);
    return sum_within(begin, end, [=](std::ptrdiff_t i) { return x[i] * w[i] * (x[i] * w[i]); });
  });
  if (own.late) own.late->clear();
  return std::sqrt(sum / double(own.length));
}

/// CVODES asks that there be such an operation, and does without.
template <class Result, class... Arguments>
Result never(Arguments...) {
  std::abort();
}

N_Vector make_like(N_Vector from) {
  N_Vector v = N_VNewEmpty(from->sunctx);
  N_VCopyOps(from, v);
  v->content = new Content{content(from).length, content(from).late};
  return v;
}

/// What its memory is still asked for would be done to another's.
void destroy(N_Vector v) {
  content(v).catch_up();
  delete &content(v);
  N_VFreeEmpty(v);
}

}  // namespace

double* data(N_Vector v) {
  content(v).catch_up();
  return values(v);
}

N_Vector make_vector(sunindextype length, SUNContext context) {
  N_Vector v = N_VNewEmpty(context);
  auto& can = *v->ops;
  can.nvclone = make_like;
  can.nvdestroy = destroy;
  can.nvgetlength = [](N_Vector of) { return sunindextype(content(of).length); };
  can.nvgetarraypointer = data;
  can.nvlinearsum = linear_sum;
  can.nvconst = fill;
  can.nvscale = scale;
  can.nvlinearcombination = linear_combination;
  can.nvscaleaddmulti = scale_add_multi;
  can.nvwrmsnorm = weighted_norm;
  can.nvprod = can.nvdiv = never;
  can.nvabs = can.nvinv = never;
  can.nvaddconst = never;
  can.nvmaxnorm = never;
  v->content = new Content{length, length < worth_a_thread ? nullptr : std::make_shared<LateWork>()};
  return v;
}

}  // namespace thermotwin::thermal
