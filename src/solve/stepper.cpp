// SPDX-License-Identifier: MIT
#include "solve/stepper.h"

#include <algorithm>

namespace tunica {

namespace {

class Euler : public Stepper {
 public:
  const char* name() const override { return "euler"; }
  int order() const override { return 1; }
  const std::vector<uint8_t>& step(System& system, double t, const double* y, double h, double* y_new) override {
    return system.euler(t, y, h, y_new);
  }
};

/// y* = y + h f(t, y);  y_new = y + h/2 (f(t, y) + f(t + h, y*))
class Heun : public Stepper {
 public:
  const char* name() const override { return "heun"; }
  int order() const override { return 2; }
  const std::vector<uint8_t>& step(System& system, double t, const double* y, double h, double* y_new) override {
    const size_t size = system.state_size();
    for (AlignedBuffer* buffer : {&first_, &second_})
      if (buffer->size() != size) buffer->resize(size);
    system.rates(t, y, first_.data());
    for (size_t i = 0; i < size; ++i) y_new[i] = y[i] + h * first_.data()[i];
    system.rates(t + h, y_new, second_.data());
    for (size_t i = 0; i < size; ++i) y_new[i] = y[i] + 0.5 * h * (first_.data()[i] + second_.data()[i]);
    flags_.assign(system.state().size(), 0);
    for (size_t k = 0; k < flags_.size(); ++k) {
      const System::StateColumn& s = system.state()[k];
      for (Index i = 0; i < s.count; ++i) {
        const double value = y_new[s.offset + i];
        if (!(value - value == 0)) flags_[k] |= not_finite;
        if (value < 0) flags_[k] |= negative;
      }
    }
    return flags_;
  }

 private:
  AlignedBuffer first_, second_;
  std::vector<uint8_t> flags_;
};

}  // namespace

std::vector<std::string> stepper_names() { return {"euler", "heun"}; }

std::unique_ptr<Stepper> make_stepper(const std::string& name) {
  if (name == "euler") return std::make_unique<Euler>();
  if (name == "heun") return std::make_unique<Heun>();
  fail("unknown method '{}'{}; there are: {}", name, did_you_mean(name, stepper_names()),
       fmt::join(stepper_names(), ", "));
}

}  // namespace tunica
