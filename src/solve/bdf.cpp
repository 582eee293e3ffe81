// SPDX-License-Identifier: MIT
#include "solve/bdf.h"

#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sunlinsol/sunlinsol_klu.h>
#include <sunlinsol/sunlinsol_spgmr.h>
#include <sunmatrix/sunmatrix_sparse.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <exception>

#include "solve/block_preconditioner.h"
#include "solve/tolerance.h"

namespace tunica {

namespace {

/// Up to so many unknowns sparse factors of the whole matrix are used: on tissues their fill grows faster than the
/// iterations of GMRES do.
constexpr int most_for_direct = 6000;
/// Of the tolerance for a step: errors of several steps stay in its history and add up, the more so after restarts.
constexpr double share_of_tolerance = 0.5;
/// After so many steps the method begins anew, so that a checkpoint never needs more to be taken again.
constexpr int steps_to_restart = 1000;

struct Free {
  void operator()(N_Vector v) const { N_VDestroy(v); }
  void operator()(SUNMatrix m) const { SUNMatDestroy(m); }
  void operator()(SUNLinearSolver s) const { SUNLinSolFree(s); }
};
struct FreeCvode {
  void operator()(void* cvode) const { CVodeFree(&cvode); }
};
template <class T>
using Owned = std::unique_ptr<std::remove_pointer_t<T>, Free>;

class Bdf : public Stepper {
 public:
  explicit Bdf(const StepperOptions& options) : norm_(share_of_tolerance * options.tolerance) {
    SUNContext_Create(nullptr, &context_);
  }
  ~Bdf() override {
    release();
    SUNContext_Free(&context_);
  }

  const char* name() const override { return "bdf"; }
  int order() const override { return 5; }
  Steps steps() const override { return Steps::own; }

  void restart(System& system, double t, const double* y) override {
    attach(system);
    if (jacobian_->size() > 0) begin(system, t, y);
    pending_ = false;
  }

  StepResult step(System& system, double t, const double* y, double h, double* y_new) override {
    attach(system);
    if (jacobian_->size() == 0) return {.taken = h};
    if (pending_) take_again(system);
    // A step that was not accepted has left the library's history ahead of the state.
    if (!begun_ || tried_ || taken_ >= steps_to_restart) begin(system, t, y);
    tried_ = true;
    return advance(system, t + h, y_new);
  }
  void accepted() override { tried_ = false; }

  void save(ByteWriter& out) const override;
  void load(ByteReader& in) override;

 private:
  void attach(System& system);
  void build();
  void release();
  void begin(System& system, double t, const double* y);
  void take_again(System& system);
  StepResult advance(System& system, double stop, double* y_new);
  StepResult failed(int flag) const;

  static int rates_callback(double t, N_Vector y, N_Vector dydt, void* self);
  static int jacobian_callback(double t, N_Vector y, N_Vector, SUNMatrix j, void* self, N_Vector, N_Vector, N_Vector);
  static int multiply_callback(N_Vector v, N_Vector out, double t, N_Vector y, N_Vector, void* self, N_Vector);
  static int setup_callback(double t, N_Vector y, N_Vector, int keep, int* renewed, double gamma, void* self);
  static int solve_callback(double, N_Vector, N_Vector, N_Vector r, N_Vector z, double, double, int, void* self);
  static int weights_callback(N_Vector y, N_Vector w, void* self);
  /// Runs `work` for a callback of the library; an exception is kept and thrown again by advance().
  template <class Work>
  int guarded(Work work);
  const double* padded(N_Vector compact) {
    jacobian_->scatter(N_VGetArrayPointer(compact), state_.data());
    return state_.data();
  }
  void evaluate(double t, N_Vector y) {
    ++work_.jacobians;
    jacobian_->evaluate(t, padded(y));
  }

  ErrorNorm norm_;
  SUNContext context_ = nullptr;
  System* system_ = nullptr;
  std::unique_ptr<Jacobian> jacobian_;
  uint64_t structure_ = 0;
  std::unique_ptr<void, FreeCvode> cvode_;
  Owned<N_Vector> y_;
  Owned<SUNMatrix> matrix_;
  Owned<SUNLinearSolver> solver_;
  BlockPreconditioner preconditioner_;
  bool direct_ = true, begun_ = false;
  bool pending_ = false;  ///< the steps since the beginning are still to be taken again
  bool tried_ = false;    ///< the last step was not accepted
  AlignedBuffer state_, rates_;
  std::exception_ptr thrown_;
  // Where it began, and the steps since: their number towards each stop.
  double origin_ = 0;
  std::vector<double> origin_state_;  ///< padded
  std::vector<std::pair<double, int>> stops_;
  int taken_ = 0;
};

template <class Work>
int Bdf::guarded(Work work) {
  try {
    return work();
  } catch (...) {
    thrown_ = std::current_exception();
    return -1;
  }
}

int Bdf::rates_callback(double t, N_Vector y, N_Vector dydt, void* self) {
  Bdf& b = *static_cast<Bdf*>(self);
  return b.guarded([&] {
    const double* padded = b.padded(y);
    b.rates(*b.system_, t, padded, b.rates_.data());
    b.jacobian_->gather(b.rates_.data(), N_VGetArrayPointer(dydt));
    double sum = 0;
    const double* rate = N_VGetArrayPointer(dydt);
    for (int i = 0; i < b.jacobian_->size(); ++i) sum += rate[i] - rate[i];
    return sum == 0 ? 0 : 1;  // not finite: the library tries a shorter step
  });
}

int Bdf::jacobian_callback(double t, N_Vector y, N_Vector, SUNMatrix j, void* self, N_Vector, N_Vector, N_Vector) {
  Bdf& b = *static_cast<Bdf*>(self);
  return b.guarded([&] {
    b.evaluate(t, y);
    ++b.work_.factorizations;
    const SparseRows& m = b.jacobian_->matrix();
    std::copy(m.begin.begin(), m.begin.end(), SUNSparseMatrix_IndexPointers(j));
    std::copy(m.column.begin(), m.column.end(), SUNSparseMatrix_IndexValues(j));
    std::copy(m.value.begin(), m.value.end(), SUNSparseMatrix_Data(j));
    return 0;
  });
}

/// J v with the Jacobian of the last setup: near enough for an inner iteration, and far cheaper than a new one.
int Bdf::multiply_callback(N_Vector v, N_Vector out, double, N_Vector, N_Vector, void* self, N_Vector) {
  Bdf& b = *static_cast<Bdf*>(self);
  ++b.work_.linear_iterations;
  b.jacobian_->matrix().multiply(N_VGetArrayPointer(v), N_VGetArrayPointer(out));
  return 0;
}

int Bdf::setup_callback(double t, N_Vector y, N_Vector, int keep, int* renewed, double gamma, void* self) {
  Bdf& b = *static_cast<Bdf*>(self);
  return b.guarded([&] {
    if (!keep) b.evaluate(t, y);
    *renewed = !keep;
    ++b.work_.factorizations;
    return b.preconditioner_.factor(*b.jacobian_, gamma) ? 0 : 1;
  });
}

int Bdf::solve_callback(double, N_Vector, N_Vector, N_Vector r, N_Vector z, double, double, int, void* self) {
  static_cast<Bdf*>(self)->preconditioner_.solve(N_VGetArrayPointer(r), N_VGetArrayPointer(z));
  return 0;
}

int Bdf::weights_callback(N_Vector y, N_Vector w, void* self) {
  Bdf& b = *static_cast<Bdf*>(self);
  const double* values = N_VGetArrayPointer(y);
  double* weights = N_VGetArrayPointer(w);
  b.norm_.scale(*b.system_, b.padded(y));
  for (size_t k = 0; k < b.system_->state().size(); ++k)
    for (int i = b.jacobian_->offsets()[k]; i < b.jacobian_->offsets()[k + 1]; ++i)
      weights[i] = 1 / (b.norm_.tolerance() * (std::fabs(values[i]) + b.norm_.column_scale(k)));
  return 0;
}

void Bdf::release() {
  cvode_.reset();
  solver_.reset();
  matrix_.reset();
  y_.reset();
  begun_ = false;
}

void Bdf::attach(System& system) {
  if (!jacobian_) {
    system_ = &system;
    jacobian_ = std::make_unique<Jacobian>(system);
  }
  jacobian_->prepare();
  if (structure_ == jacobian_->structure()) return;
  structure_ = jacobian_->structure();
  for (AlignedBuffer* buffer : {&state_, &rates_}) buffer->resize(system.state_size());
  build();
}

void Bdf::build() {
  release();
  const int n = jacobian_->size();
  if (n == 0) return;
  direct_ = n <= most_for_direct;
  y_.reset(N_VNew_Serial(n, context_));
  N_VConst(0, y_.get());
  cvode_.reset(CVodeCreate(CV_BDF, context_));
  void* cvode = cvode_.get();
  CVodeInit(cvode, rates_callback, 0, y_.get());
  CVodeSetUserData(cvode, this);
  CVodeSetErrHandlerFn(
      cvode, [](int, const char*, const char*, char*, void*) {}, nullptr);
  CVodeWFtolerances(cvode, weights_callback);
  CVodeSetMaxNumSteps(cvode, -1);
  if (direct_) {
    const auto entries = static_cast<sunindextype>(jacobian_->matrix().value.size());
    matrix_.reset(SUNSparseMatrix(n, n, entries, CSR_MAT, context_));
    const SparseRows& m = jacobian_->matrix();
    std::copy(m.begin.begin(), m.begin.end(), SUNSparseMatrix_IndexPointers(matrix_.get()));
    std::copy(m.column.begin(), m.column.end(), SUNSparseMatrix_IndexValues(matrix_.get()));
    solver_.reset(SUNLinSol_KLU(y_.get(), matrix_.get(), context_));
    SUNLinSol_KLUSetOrdering(solver_.get(), 0);  // minimum degree
    CVodeSetLinearSolver(cvode, solver_.get(), matrix_.get());
    CVodeSetJacFn(cvode, jacobian_callback);
    return;
  }
  preconditioner_.analyse(*jacobian_);
  solver_.reset(SUNLinSol_SPGMR(y_.get(), SUN_PREC_LEFT, 0, context_));
  CVodeSetLinearSolver(cvode, solver_.get(), nullptr);
  CVodeSetPreconditioner(cvode, setup_callback, solve_callback);
  CVodeSetJacTimes(cvode, nullptr, multiply_callback);
}

void Bdf::begin(System& system, double t, const double* y) {
  jacobian_->gather(y, N_VGetArrayPointer(y_.get()));
  tried_ = false;
  origin_ = t;
  origin_state_.assign(y, y + system.state_size());
  stops_.clear();
  taken_ = 0;
  CVodeReInit(cvode_.get(), t, y_.get());
  begun_ = true;
}

StepResult Bdf::advance(System& system, double stop, double* y_new) {
  void* cvode = cvode_.get();
  double from = origin_, reached = 0;
  if (taken_ > 0) CVodeGetCurrentTime(cvode, &from);
  if (stops_.empty() || stops_.back().first != stop) stops_.push_back({stop, 0});
  CVodeSetStopTime(cvode, stop);
  thrown_ = nullptr;
  const int flag = CVode(cvode, stop, y_.get(), &reached, CV_ONE_STEP);
  if (thrown_) {
    pending_ = true;  // the library's inner state has moved on: it is built up again before the next step
    std::rethrow_exception(thrown_);
  }
  if (flag < 0) return failed(flag);
  ++stops_.back().second;
  ++taken_;
  std::fill_n(y_new, system.state_size(), 0.0);
  jacobian_->scatter(N_VGetArrayPointer(y_.get()), y_new);
  return {.taken = reached - from};
}

StepResult Bdf::failed(int flag) const {
  const char* kind = flag == CV_ERR_FAILURE || flag == CV_TOO_MUCH_ACC  ? "step size"
                     : flag == CV_CONV_FAILURE                          ? "newton"
                     : flag == CV_LSETUP_FAIL || flag == CV_LSOLVE_FAIL ? "linear"
                                                                        : "not finite";
  char* text = CVodeGetReturnFlagName(flag);
  std::string name = text;
  free(text);
  return {
      .failed = kind,
      .detail = fmt::format("CVODE could not take a step ({}); the rates may be discontinuous or grow without bound: "
                            "look at the rules, or try another tolerance",
                            name)};
}

void Bdf::take_again(System& system) {
  AlignedBuffer y;
  y.resize(origin_state_.size());
  std::copy(origin_state_.begin(), origin_state_.end(), y.data());
  const auto stops = stops_;
  const Work before = work_;
  try {
    begin(system, origin_, y.data());
    for (const auto& [stop, count] : stops)
      for (int i = 0; i < count; ++i) {
        const StepResult result = advance(system, stop, state_.data());
        if (result.failed) fail("internal: steps of a checkpoint could not be taken again: {}", result.detail);
      }
  } catch (...) {  // broken off: all of them are still to be taken
    stops_ = stops;
    work_ = before;
    pending_ = true;
    throw;
  }
  work_ = before;
  pending_ = false;
}

void Bdf::save(ByteWriter& out) const {
  out.put(static_cast<uint8_t>(begun_));
  if (!begun_) return;
  out.put(origin_);
  out.put(static_cast<uint64_t>(origin_state_.size()));
  for (const double y : origin_state_) out.put(y);
  out.put(static_cast<uint64_t>(stops_.size()));
  for (const auto& [stop, count] : stops_) out.put(stop), out.put(static_cast<int32_t>(count));
}

void Bdf::load(ByteReader& in) {
  pending_ = begun_ = in.get<uint8_t>() != 0;
  if (!begun_) return;
  origin_ = in.get<double>();
  origin_state_.resize(in.get<uint64_t>());
  for (double& y : origin_state_) y = in.get<double>();
  stops_.resize(in.get<uint64_t>());
  for (auto& [stop, count] : stops_) stop = in.get<double>(), count = in.get<int32_t>();
}

}  // namespace

std::unique_ptr<Stepper> make_bdf(const StepperOptions& options) { return std::make_unique<Bdf>(options); }

}  // namespace tunica
