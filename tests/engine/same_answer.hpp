// What must agree bit for bit between methods, thread counts, instruction sets and batch orders.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "landfall/error.hpp"
#include "landfall/search.hpp"

namespace landfall::testing {

// The answer, or the error's message as an answer's reason.
inline SearchResult answer_or_error(const PreparedMap& map, const PosePrior& prior, const Scan& scan,
                                    const SearchOptions& options) {
  try {
    return search(map, prior, scan, options);
  } catch (const Error& error) {
    SearchResult refused;
    refused.reason = error.what();
    return refused;
  }
}

inline void expect_same_answer(const SearchResult& a, const SearchResult& b) {
  EXPECT_EQ(a.verdict, b.verdict);
  EXPECT_EQ(a.reason, b.reason);
  EXPECT_EQ(a.proven, b.proven);
  EXPECT_EQ(a.counts.poses_covered, b.counts.poses_covered);
  ASSERT_EQ(a.hypotheses.size(), b.hypotheses.size());
  for (std::size_t i = 0; i < a.hypotheses.size(); ++i) {
    SCOPED_TRACE("hypothesis " + std::to_string(i));
    EXPECT_EQ(a.hypotheses[i].score, b.hypotheses[i].score);
    EXPECT_EQ(a.hypotheses[i].T_map_robot_unrefined, b.hypotheses[i].T_map_robot_unrefined);
    EXPECT_EQ(a.hypotheses[i].T_map_robot, b.hypotheses[i].T_map_robot);
    EXPECT_EQ(a.hypotheses[i].probability, b.hypotheses[i].probability);
    EXPECT_EQ(a.hypotheses[i].explained, b.hypotheses[i].explained);
    EXPECT_EQ(a.hypotheses[i].map_index, b.hypotheses[i].map_index);
  }
}

}  // namespace landfall::testing
