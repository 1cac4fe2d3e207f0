#include "joints/joint_system.h"

#include <algorithm>
#include <cmath>

namespace tweenfall::joints {

namespace {

/// More blocks than this for a joint are more work than going around joint by joint.
constexpr std::size_t most_blocks = 16;
constexpr std::uint32_t unseen = 0xffffffffu;
/// Rows with bounds may nearly say what others say already; with so much more of their own inverse mass they do not ask
/// for any impulse, and are met all the same when solved once more.
constexpr double caution = 0.003;

/// Three rows are what most joints have, and some more at their bounds: known to the compiler, their loops are
/// unrolled.
template <class Call>
void sized(std::size_t rows, const Call& call) {
  switch (rows) {
    case 3:
      return call(std::integral_constant<std::size_t, 3>());
    case 4:
      return call(std::integral_constant<std::size_t, 4>());
    case 5:
      return call(std::integral_constant<std::size_t, 5>());
    default:
      return call(rows);
  }
}

/// How an impulse along one row changes the speed that another sees through a body that both hold.
struct Coupling {
  bool first_by_b, second_by_b;
  double inverse_mass;
  double operator()(const Row& first, const Row& second) const {
    const Vec3& linear1 = first_by_b ? first.direction.linear_b : first.direction.linear_a;
    const Vec3& linear2 = second_by_b ? second.direction.linear_b : second.direction.linear_a;
    const Vec3& turn1 = first_by_b ? first.direction.turn_b : first.direction.turn_a;
    const Vec3& spin2 = second_by_b ? second.spin_b : second.spin_a;
    const double sum = inverse_mass * linear1.dot(linear2) + turn1.dot(spin2);
    return first_by_b == second_by_b ? sum : -sum;
  }
};

/// lower x = values. On the diagonal stand the inverses of its numbers, or 0.
template <class Rows>
void solve_lower(const double* lower, double* values, Rows rows) {
  for (std::size_t i = 0; i < rows; ++i) {
    double sum = values[i];
    for (std::size_t k = 0; k < i; ++k) sum -= lower[i * rows + k] * values[k];
    values[i] = lower[i * rows + i] > 0 ? sum * lower[i * rows + i] : 0;
  }
}

/// lower^T x = values
template <class Rows>
void solve_upper(const double* lower, double* values, Rows rows) {
  for (std::size_t i = rows; i-- > 0;) {
    double sum = values[i];
    for (std::size_t k = i + 1; k < rows; ++k) sum -= lower[k * rows + i] * values[k];
    values[i] = lower[i * rows + i] > 0 ? sum * lower[i * rows + i] : 0;
  }
}

}  // namespace

void JointSystem::Plans::fit(std::size_t places) {
  if (at_body.size() >= places) return;
  at_body.resize(places);
  depth.resize(places, unseen);
}

bool JointSystem::plan(std::span<const Member> members, Plans& plans) {
  members_.assign(members.begin(), members.end());
  for (std::uint32_t i = 0; i < members_.size(); ++i) {
    if (members_[i].a_moves) plans.at_body[members_[i].a].push_back(i);
    if (members_[i].b_moves) plans.at_body[members_[i].b].push_back(i);
  }
  order(plans);
  const bool found = find_structure(plans);
  for (const Member& member : members)
    for (const std::uint32_t end : {member.a, member.b}) {
      plans.at_body[end].clear();
      plans.depth[end] = unseen;
    }
  if (!found) return false;
  counts_.resize(members_.size());
  slots_.resize(members_.size());
  first_value_.resize(members_.size());
  diagonal_.resize(members_.size());
  below_.resize(later_.size());
  return true;
}

/// By distance from where each tree hangs, the farthest first.
void JointSystem::order(Plans& plans) {
  std::vector<std::uint32_t>& depth = plans.depth;
  std::vector<std::uint32_t>& queue = plans.queue;
  queue.clear();
  const auto start = [&](std::uint32_t body) {
    if (depth[body] != unseen) return;
    depth[body] = 0;
    queue.push_back(body);
  };
  std::size_t from = 0;
  const auto spread = [&] {
    for (; from < queue.size(); ++from) {
      const std::uint32_t body = queue[from];
      for (const std::uint32_t i : plans.at_body[body]) {
        const Member& member = members_[i];
        for (const std::uint32_t end : {member.a, member.b}) {
          if (!(end == member.a ? member.a_moves : member.b_moves) || depth[end] != unseen) continue;
          depth[end] = depth[body] + 1;
          queue.push_back(end);
        }
      }
    }
  };
  // What hangs on something that cannot move begins there.
  for (const Member& member : members_) {
    if (!member.a_moves && member.b_moves) start(member.b);
    if (!member.b_moves && member.a_moves) start(member.a);
  }
  spread();
  for (const Member& member : members_) {
    if (member.a_moves) start(member.a);
    if (member.b_moves) start(member.b);
    spread();
  }
  const auto depth_of = [&](std::uint32_t i) {
    const Member& member = members_[i];
    // One that hangs on something fixed lies a step nearer than any other of its body.
    const std::uint32_t a = member.a_moves ? depth[member.a] + 1 : 0;
    const std::uint32_t b = member.b_moves ? depth[member.b] + 1 : 0;
    return a + b;
  };
  std::vector<std::uint32_t>& chosen = plans.queue;
  chosen.resize(members_.size());
  for (std::uint32_t i = 0; i < chosen.size(); ++i) chosen[i] = i;
  std::sort(chosen.begin(), chosen.end(), [&](std::uint32_t left, std::uint32_t right) {
    const std::uint32_t depth_left = depth_of(left), depth_right = depth_of(right);
    return depth_left != depth_right ? depth_left > depth_right : left < right;
  });
  plans.place_of.resize(members_.size());
  for (std::uint32_t place = 0; place < chosen.size(); ++place) plans.place_of[chosen[place]] = place;
}

bool JointSystem::find_structure(Plans& plans) {
  const std::size_t count = members_.size();
  if (plans.later.size() < count) plans.later.resize(count);
  for (std::size_t place = 0; place < count; ++place) plans.later[place].clear();
  std::size_t pairs = 0;
  // Of a body's members each acts on all that come later; a body of very many is no tree's.
  for (std::uint32_t i = 0; i < count; ++i)
    for (const bool by_b : {false, true}) {
      if (!(by_b ? members_[i].b_moves : members_[i].a_moves)) continue;
      const std::vector<std::uint32_t>& others = plans.at_body[by_b ? members_[i].b : members_[i].a];
      pairs += others.size();
      if (pairs > 2 * most_blocks * count + 2) return false;
      for (const std::uint32_t k : others)
        if (plans.place_of[k] > plans.place_of[i]) plans.later[plans.place_of[i]].push_back(plans.place_of[k]);
    }
  first_.resize(count + 1);
  later_.clear();
  for (std::size_t place = 0; place < count; ++place) {
    std::vector<std::uint32_t>& own = plans.later[place];
    std::sort(own.begin(), own.end());
    own.erase(std::unique(own.begin(), own.end()), own.end());
    first_[place] = static_cast<std::uint32_t>(later_.size());
    later_.insert(later_.end(), own.begin(), own.end());
    if (later_.size() > most_blocks * count) return false;
    // What it acts on acts on each other once it is gone.
    if (!own.empty()) plans.later[own.front()].insert(plans.later[own.front()].end(), own.begin() + 1, own.end());
  }
  first_[count] = static_cast<std::uint32_t>(later_.size());
  std::vector<Member>& ordered = members_;
  const std::vector<Member> given = members_;
  for (std::size_t i = 0; i < count; ++i) ordered[plans.place_of[i]] = given[i];
  return true;
}

void JointSystem::lay_out() {
  std::uint32_t value = 0;
  std::uint32_t block = 0;
  for (std::size_t place = 0; place < members_.size(); ++place) {
    const JointRows& rows = *members_[place].rows;
    std::uint8_t count = 0;
    for (std::uint8_t slot = 0; slot < rows.count; ++slot)
      if (rows.parts[slot] == Part::in) slots_[place][count++] = slot;
    counts_[place] = count;
    first_value_[place] = value;
    diagonal_[place] = block;
    value += count;
    block += std::uint32_t{count} * count;
  }
  for (std::size_t place = 0; place < members_.size(); ++place)
    for (std::uint32_t n = first_[place]; n < first_[place + 1]; ++n) {
      below_[n] = block;
      block += std::uint32_t{counts_[later_[n]]} * counts_[place];
    }
  values_.resize(value);
  inverses_.resize(value);
  blocks_.resize(block);
}

void JointSystem::fill(std::size_t place) {
  const Member& own = members_[place];
  const Masses& masses = own.rows->masses();
  const std::array<Row, most_rows>& rows = own.rows->rows;
  const std::array<std::uint8_t, most_rows>& slots = slots_[place];
  double* diagonal = this->diagonal(place);
  double* inverses = inverses_.data() + first_value_[place];
  const Coupling by_a{false, false, masses.inverse_mass_a};
  const Coupling by_b{true, true, masses.inverse_mass_b};
  sized(counts_[place], [&](auto count) {
    for (std::size_t i = 0; i < count; ++i) {
      const Row& row = rows[slots[i]];
      for (std::size_t k = 0; k <= i; ++k)
        diagonal[i * count + k] = by_a(row, rows[slots[k]]) + by_b(row, rows[slots[k]]);
      inverses[i] = diagonal[i * count + i];
      const bool careful = slots[i] >= own.rows->together && row.compliance == 0;
      diagonal[i * count + i] = (1 + (careful ? caution : give)) * inverses[i] + row.compliance;
    }
  });
  for (std::uint32_t n = first_[place]; n < first_[place + 1]; ++n) {
    const Member& other = members_[later_[n]];
    const std::array<Row, most_rows>& others = other.rows->rows;
    const std::array<std::uint8_t, most_rows>& other_slots = slots_[later_[n]];
    double* block = blocks_.data() + below_[n];
    std::fill_n(block, counts_[later_[n]] * counts_[place], 0.0);
    const auto share = [&](bool other_by_b, bool own_by_b) {
      const Coupling coupling{other_by_b, own_by_b, own_by_b ? masses.inverse_mass_b : masses.inverse_mass_a};
      sized(counts_[place], [&](auto columns) {
        sized(counts_[later_[n]], [&](auto count) {
          for (std::size_t i = 0; i < count; ++i)
            for (std::size_t k = 0; k < columns; ++k)
              block[i * columns + k] += coupling(others[other_slots[i]], rows[slots[k]]);
        });
      });
    };
    if (own.a_moves && other.a_moves && own.a == other.a) share(false, false);
    if (own.a_moves && other.b_moves && own.a == other.b) share(true, false);
    if (own.b_moves && other.a_moves && own.b == other.a) share(false, true);
    if (own.b_moves && other.b_moves && own.b == other.b) share(true, true);
  }
}

void JointSystem::factor_diagonal(std::size_t place) {
  double* block = diagonal(place);
  const double* inverses = this->inverses(place);
  sized(counts_[place], [&](auto rows) {
    for (std::size_t i = 0; i < rows; ++i)
      for (std::size_t k = 0; k <= i; ++k) {
        double sum = block[i * rows + k];
        for (std::size_t m = 0; m < k; ++m) sum -= block[i * rows + m] * block[k * rows + m];
        if (k < i)
          block[i * rows + k] = block[k * rows + k] > 0 ? sum * block[k * rows + k] : 0;
        else
          block[i * rows + i] = sum > new_enough * inverses[i] ? 1 / std::sqrt(sum) : 0;
      }
  });
}

/// Takes what the place does to those after it out of them.
void JointSystem::eliminate(std::size_t place) {
  const double* diagonal = this->diagonal(place);
  sized(counts_[place], [&](auto columns) {
    for (std::uint32_t n = first_[place]; n < first_[place + 1]; ++n) {
      double* block = blocks_.data() + below_[n];
      sized(counts_[later_[n]], [&](auto rows) {
        for (std::size_t i = 0; i < rows; ++i) solve_lower(diagonal, block + i * columns, columns);
      });
    }
    for (std::uint32_t n = first_[place]; n < first_[place + 1]; ++n) {
      const std::uint32_t column = later_[n];
      const double* right = blocks_.data() + below_[n];
      std::uint32_t target = first_[column];
      for (std::uint32_t p = n; p < first_[place + 1]; ++p) {
        const double* left = blocks_.data() + below_[p];
        double* into = this->diagonal(column);
        if (p > n) {
          while (later_[target] != later_[p]) ++target;
          into = blocks_.data() + below_[target];
        }
        const bool lower = p == n;
        sized(counts_[later_[p]], [&](auto rows) {
          sized(counts_[column], [&](auto others) {
            for (std::size_t i = 0; i < rows; ++i)
              for (std::size_t k = 0; k < (lower ? i + 1 : std::size_t{others}); ++k) {
                double sum = 0;
                for (std::size_t m = 0; m < columns; ++m) sum += left[i * columns + m] * right[k * columns + m];
                into[i * others + k] -= sum;
              }
          });
        });
      }
    }
  });
}

void JointSystem::factor() {
  lay_out();
  for (std::size_t place = 0; place < members_.size(); ++place) fill(place);
  for (std::size_t place = 0; place < members_.size(); ++place) {
    factor_diagonal(place);
    eliminate(place);
  }
}

void JointSystem::solve() {
  for (std::size_t place = 0; place < members_.size(); ++place)
    sized(counts_[place], [&](auto columns) {
      double* own = values(place);
      solve_lower(diagonal(place), own, columns);
      for (std::uint32_t n = first_[place]; n < first_[place + 1]; ++n) {
        const double* block = blocks_.data() + below_[n];
        double* other = values(later_[n]);
        sized(counts_[later_[n]], [&](auto rows) {
          for (std::size_t i = 0; i < rows; ++i)
            for (std::size_t k = 0; k < columns; ++k) other[i] -= block[i * columns + k] * own[k];
        });
      }
    });
  for (std::size_t place = members_.size(); place-- > 0;)
    sized(counts_[place], [&](auto columns) {
      double* own = values(place);
      for (std::uint32_t n = first_[place]; n < first_[place + 1]; ++n) {
        const double* block = blocks_.data() + below_[n];
        const double* other = values(later_[n]);
        sized(counts_[later_[n]], [&](auto rows) {
          for (std::size_t i = 0; i < rows; ++i)
            for (std::size_t k = 0; k < columns; ++k) own[k] -= block[i * columns + k] * other[i];
        });
      }
      solve_upper(diagonal(place), own, columns);
    });
}

}  // namespace tweenfall::joints
