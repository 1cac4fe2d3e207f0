#include "joints/joint_system.h"

#include <algorithm>
#include <cmath>

namespace tweenfall::joints {

namespace {

/// More blocks than this for a joint are more work than going around joint by joint.
constexpr std::size_t most_blocks = 16;
constexpr std::uint32_t unseen = 0xffffffffu;

/// How an impulse along one row changes the speed that another sees through a body that both hold.
double coupling(const Row& first, bool first_by_b, const Row& second, bool second_by_b, double inverse_mass) {
  const Vec3& linear1 = first_by_b ? first.direction.linear_b : first.direction.linear_a;
  const Vec3& linear2 = second_by_b ? second.direction.linear_b : second.direction.linear_a;
  const Vec3& turn1 = first_by_b ? first.direction.turn_b : first.direction.turn_a;
  const Vec3& spin2 = second_by_b ? second.spin_b : second.spin_a;
  const double sum = inverse_mass * linear1.dot(linear2) + turn1.dot(spin2);
  return first_by_b == second_by_b ? sum : -sum;
}

}  // namespace

void JointSystem::plan(std::span<const Member> members, std::size_t places) {
  members_.assign(members.begin(), members.end());
  order_.resize(members.size());
  for (std::uint32_t i = 0; i < order_.size(); ++i) order_[i] = i;
  place_of_ = order_;
  if (at_body_.size() < places) at_body_.resize(places);
  for (std::vector<std::uint32_t>& list : at_body_) list.clear();
  for (std::uint32_t i = 0; i < members_.size(); ++i) {
    if (members_[i].a_moves) at_body_[members_[i].a].push_back(i);
    if (members_[i].b_moves) at_body_[members_[i].b].push_back(i);
  }
  if (later_.size() < members_.size()) later_.resize(members_.size());
  for (std::vector<std::uint32_t>& list : later_) list.clear();
  diagonal_.resize(members_.size());
  first_.assign(members_.size(), 0);
  below_.clear();
  std::size_t pairs = 0;
  for (const std::vector<std::uint32_t>& list : at_body_) pairs += list.size() * list.size() / 2;
  whole_ = members_.size() > 1 && pairs <= most_blocks * members_.size();
  if (!whole_) return;
  order(places);
  find_structure(places);
}

/// By distance from where each tree hangs, the farthest first.
void JointSystem::order(std::size_t places) {
  depth_.assign(places, unseen);
  queue_.clear();
  const auto spread = [&](std::size_t from) {
    for (; from < queue_.size(); ++from) {
      const std::uint32_t body = queue_[from];
      for (const std::uint32_t i : at_body_[body]) {
        const Member& member = members_[i];
        for (const std::uint32_t end : {member.a, member.b}) {
          if (!(end == member.a ? member.a_moves : member.b_moves) || depth_[end] != unseen) continue;
          depth_[end] = depth_[body] + 1;
          queue_.push_back(end);
        }
      }
    }
  };
  const auto start = [&](std::uint32_t body) {
    if (depth_[body] != unseen) return;
    depth_[body] = 0;
    queue_.push_back(body);
  };
  // What hangs on something that cannot move begins there.
  for (const Member& member : members_) {
    if (!member.a_moves && member.b_moves) start(member.b);
    if (!member.b_moves && member.a_moves) start(member.a);
  }
  spread(0);
  for (const Member& member : members_)
    for (const std::uint32_t end : {member.a, member.b}) {
      if (!(end == member.a ? member.a_moves : member.b_moves) || depth_[end] != unseen) continue;
      const std::size_t from = queue_.size();
      start(end);
      spread(from);
    }
  const auto depth_of = [&](std::uint32_t i) {
    const Member& member = members_[i];
    // One that hangs on something fixed lies a step nearer than any other of its body.
    const std::uint32_t a = member.a_moves ? depth_[member.a] + 1 : 0;
    const std::uint32_t b = member.b_moves ? depth_[member.b] + 1 : 0;
    return a + b;
  };
  std::sort(order_.begin(), order_.end(), [&](std::uint32_t left, std::uint32_t right) {
    const std::uint32_t depth_left = depth_of(left), depth_right = depth_of(right);
    return depth_left != depth_right ? depth_left > depth_right : left < right;
  });
  for (std::uint32_t place = 0; place < order_.size(); ++place) place_of_[order_[place]] = place;
}

void JointSystem::find_structure(std::size_t places) {
  for (std::size_t body = 0; body < places; ++body)
    for (const std::uint32_t i : at_body_[body])
      for (const std::uint32_t k : at_body_[body])
        if (place_of_[k] > place_of_[i]) later_[place_of_[i]].push_back(place_of_[k]);
  std::size_t blocks = 0;
  for (std::size_t place = 0; place < order_.size(); ++place) {
    std::vector<std::uint32_t>& own = later_[place];
    std::sort(own.begin(), own.end());
    own.erase(std::unique(own.begin(), own.end()), own.end());
    first_[place] = blocks;
    blocks += own.size();
    if (blocks > most_blocks * order_.size()) {
      whole_ = false;
      return;
    }
    // What it acts on acts on each other once it is gone.
    if (!own.empty()) later_[own.front()].insert(later_[own.front()].end(), own.begin() + 1, own.end());
  }
  below_.resize(blocks);
}

void JointSystem::fill(std::span<const Masses> masses) {
  for (Block& block : below_) block = {};
  for (std::size_t place = 0; place < order_.size(); ++place) {
    const Member& own = members_[order_[place]];
    const Masses& mass = masses[order_[place]];
    const std::vector<std::uint32_t>& later = later_[place];
    for (std::size_t n = 0; n < later.size(); ++n) {
      const Member& other = members_[order_[later[n]]];
      Block& block = below_[first_[place] + n];
      const auto share = [&](bool other_by_b, bool own_by_b, double inverse_mass) {
        for (std::size_t i = 0; i < other.rows->together; ++i)
          for (std::size_t k = 0; k < own.rows->together; ++k)
            block.at[i][k] += coupling(other.rows->rows[i], other_by_b, own.rows->rows[k], own_by_b, inverse_mass);
      };
      if (own.a_moves && other.a_moves && own.a == other.a) share(false, false, mass.inverse_mass_a);
      if (own.a_moves && other.b_moves && own.a == other.b) share(true, false, mass.inverse_mass_a);
      if (own.b_moves && other.a_moves && own.b == other.a) share(false, true, mass.inverse_mass_b);
      if (own.b_moves && other.b_moves && own.b == other.b) share(true, true, mass.inverse_mass_b);
    }
  }
}

void JointSystem::factor(std::span<const Masses> masses) {
  for (std::size_t place = 0; place < order_.size(); ++place) {
    const JointRows& own = *members_[order_[place]].rows;
    const Masses& mass = masses[order_[place]];
    for (std::size_t i = 0; i < own.together; ++i)
      for (std::size_t k = 0; k <= i; ++k)
        diagonal_[place].at[i][k] = coupling(own.rows[i], false, own.rows[k], false, mass.inverse_mass_a) +
                                    coupling(own.rows[i], true, own.rows[k], true, mass.inverse_mass_b);
  }
  for (std::size_t place = 0; place < order_.size(); ++place)
    for (std::size_t i = 0; i < rows_at(place); ++i) diagonal_[place].at[i][i] *= 1 + give;
  if (whole_) fill(masses);
  for (std::size_t place = 0; place < order_.size(); ++place) {
    factor_diagonal(place);
    if (!whole_) continue;
    const std::size_t columns = rows_at(place);
    const Block& diagonal = diagonal_[place];
    const std::vector<std::uint32_t>& later = later_[place];
    for (std::size_t n = 0; n < later.size(); ++n) {
      Block& block = below_[first_[place] + n];
      for (std::size_t i = 0; i < rows_at(later[n]); ++i)
        for (std::size_t k = 0; k < columns; ++k) {
          double sum = block.at[i][k];
          for (std::size_t m = 0; m < k; ++m) sum -= block.at[i][m] * diagonal.at[k][m];
          block.at[i][k] = diagonal.at[k][k] > 0 ? sum / diagonal.at[k][k] : 0;
        }
    }
    for (std::size_t n = 0; n < later.size(); ++n) {
      const std::uint32_t column = later[n];
      const Block& right = below_[first_[place] + n];
      std::size_t target = 0;
      for (std::size_t p = n; p < later.size(); ++p) {
        const Block& left = below_[first_[place] + p];
        Block* into = &diagonal_[column];
        if (p > n) {
          while (later_[column][target] != later[p]) ++target;
          into = &below_[first_[column] + target];
        }
        for (std::size_t i = 0; i < rows_at(later[p]); ++i)
          for (std::size_t k = 0; k < (p > n ? rows_at(column) : i + 1); ++k) {
            double sum = 0;
            for (std::size_t m = 0; m < columns; ++m) sum += left.at[i][m] * right.at[k][m];
            into->at[i][k] -= sum;
          }
      }
    }
  }
}

void JointSystem::factor_diagonal(std::size_t place) {
  JointRows& own = *members_[order_[place]].rows;
  Block& block = diagonal_[place];
  for (std::size_t i = 0; i < own.together; ++i) {
    for (std::size_t k = 0; k <= i; ++k) {
      double sum = block.at[i][k];
      for (std::size_t m = 0; m < k; ++m) sum -= block.at[i][m] * block.at[k][m];
      if (k < i)
        block.at[i][k] = block.at[k][k] > 0 ? sum / block.at[k][k] : 0;
      else
        block.at[i][i] = sum * own.rows[i].mass > new_enough ? std::sqrt(sum) : 0;
    }
    if (block.at[i][i] == 0) own.rows[i].impulse = 0;
  }
}

void JointSystem::solve_alone(std::size_t member, Values& values) const {
  const std::size_t count = members_[member].rows->together;
  const Block& block = diagonal_[place_of_[member]];
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t k = 0; k < i; ++k) values[i] -= block.at[i][k] * values[k];
    values[i] = block.at[i][i] > 0 ? values[i] / block.at[i][i] : 0;
  }
  for (std::size_t i = count; i-- > 0;) {
    for (std::size_t k = i + 1; k < count; ++k) values[i] -= block.at[k][i] * values[k];
    values[i] = block.at[i][i] > 0 ? values[i] / block.at[i][i] : 0;
  }
}

void JointSystem::solve(std::vector<Values>& values) const {
  const std::size_t count = order_.size();
  for (std::size_t place = 0; place < count; ++place) {
    Values& own = values[order_[place]];
    const Block& block = diagonal_[place];
    const std::size_t rows = rows_at(place);
    for (std::size_t i = 0; i < rows; ++i) {
      for (std::size_t k = 0; k < i; ++k) own[i] -= block.at[i][k] * own[k];
      own[i] = block.at[i][i] > 0 ? own[i] / block.at[i][i] : 0;
    }
    for (std::size_t n = 0; n < later_[place].size(); ++n) {
      const Block& below = below_[first_[place] + n];
      Values& other = values[order_[later_[place][n]]];
      for (std::size_t i = 0; i < rows_at(later_[place][n]); ++i)
        for (std::size_t k = 0; k < rows; ++k) other[i] -= below.at[i][k] * own[k];
    }
  }
  for (std::size_t place = count; place-- > 0;) {
    Values& own = values[order_[place]];
    const Block& block = diagonal_[place];
    const std::size_t rows = rows_at(place);
    for (std::size_t n = 0; n < later_[place].size(); ++n) {
      const Block& below = below_[first_[place] + n];
      const Values& other = values[order_[later_[place][n]]];
      for (std::size_t i = 0; i < rows_at(later_[place][n]); ++i)
        for (std::size_t k = 0; k < rows; ++k) own[k] -= below.at[i][k] * other[i];
    }
    for (std::size_t i = rows; i-- > 0;) {
      for (std::size_t k = i + 1; k < rows; ++k) own[i] -= block.at[k][i] * own[k];
      own[i] = block.at[i][i] > 0 ? own[i] / block.at[i][i] : 0;
    }
  }
}

}  // namespace tweenfall::joints
