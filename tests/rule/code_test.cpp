// SPDX-License-Identifier: MIT
// The elementwise operations are listed twice, and one is turned into the other by position: the lists must agree.
#include "rule/code.h"

#include "rule/graph.h"

namespace tunica {

#define SAME_PLACE(name)                                                      \
  static_assert(static_cast<int>(Code::name) - static_cast<int>(Code::neg) == \
                    static_cast<int>(Op::name) - static_cast<int>(Op::neg),   \
                #name " has another place in Code than in Op")

SAME_PLACE(neg);
SAME_PLACE(exp);
SAME_PLACE(log);
SAME_PLACE(sqrt);
SAME_PLACE(sin);
SAME_PLACE(cos);
SAME_PLACE(tanh);
SAME_PLACE(abs);
SAME_PLACE(add);
SAME_PLACE(sub);
SAME_PLACE(mul);
SAME_PLACE(div);
SAME_PLACE(pow);
SAME_PLACE(min);
SAME_PLACE(max);
SAME_PLACE(less);
SAME_PLACE(less_equal);
SAME_PLACE(equal);
SAME_PLACE(select);

#undef SAME_PLACE

static_assert(static_cast<int>(Code::select) - static_cast<int>(Code::neg) == 18,
              "an operation is missing in the list above");

}  // namespace tunica
