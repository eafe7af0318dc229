#include "twin/compensation/outbox.h"

#include <gtest/gtest.h>
#include <thread>
#include <vector>

namespace thermotwin::twin {
namespace {

using namespace std::chrono_literals;

/// The next ones, which must be there.
std::vector<std::string> sent_by(Outbox& outbox, int messages) {
  std::vector<std::string> payloads;
  for (int i = 0; i < messages; ++i) payloads.push_back(outbox.next().value().payload);
  return payloads;
}

void put(Outbox& outbox, int first, int last) {
  for (int i = first; i <= last; ++i) EXPECT_TRUE(outbox.put("count", std::to_string(i), false));
}

using Payloads = std::vector<std::string>;

TEST(Outbox, SendsInOrderOnceThereIsAConnection) {
  Outbox outbox({});
  put(outbox, 1, 3);
  EXPECT_EQ(outbox.next(), std::nullopt) << "nobody is there";
  outbox.connected();
  EXPECT_EQ(sent_by(outbox, 3), (Payloads{"1", "2", "3"}));
}

/// In doubt: sent without an acknowledgement, and acknowledged by a broker that may not have handed it on.
TEST(Outbox, SendsAgainWhatIsInDoubtBeforeAllElseAndInOrder) {
  Outbox outbox({.doubt = 5s});
  auto const start = Outbox::Clock::now();
  outbox.connected();
  put(outbox, 1, 5);
  sent_by(outbox, 4);
  outbox.acknowledged(1, start);
  outbox.acknowledged(2, start + 2s);
  outbox.disconnected(start + 6s);
  put(outbox, 6, 6);
  outbox.connected();
  EXPECT_EQ(sent_by(outbox, 5), (Payloads{"2", "3", "4", "5", "6"})) << "the broker has had time to hand on the first";
}

TEST(Outbox, TakesNoAcknowledgementFromABrokenConnection) {
  Outbox outbox({});
  outbox.connected();
  put(outbox, 1, 1);
  auto const number = outbox.next()->number;
  outbox.disconnected();
  outbox.connected();
  auto const again = outbox.next()->number;
  EXPECT_NE(again, number);
  outbox.acknowledged(number);
  EXPECT_FALSE(outbox.drained(Outbox::Clock::now()));
  outbox.acknowledged(again);
  EXPECT_TRUE(outbox.drained(Outbox::Clock::now()));
}

/// However often the broker dies, a receiver that drops repeats gets everything once, in order. Every other broker
/// hands on three at a time what it acknowledged; the others die with all of it.
TEST(Outbox, LosesNothingToABrokerThatDiesWithWhatItHas) {
  Outbox outbox({});
  constexpr int messages = 100;
  put(outbox, 1, messages);
  int received = 0;
  for (int life = 1; received < messages && life <= 100; ++life) {
    outbox.connected();
    std::vector<int> held;
    for (int i = 1; i <= 5 * life && !outbox.drained(Outbox::Clock::now()); ++i) {
      auto const message = outbox.next().value();
      outbox.acknowledged(message.number);
      held.push_back(std::stoi(message.payload));
      if (life % 2 == 1 || (i % 3 != 0 && !outbox.drained(Outbox::Clock::now()))) continue;
      for (int const number : held) {
        EXPECT_LE(number, received + 1) << "a gap";
        received = std::max(received, number);
      }
      held.clear();
    }
    outbox.disconnected();
  }
  EXPECT_EQ(received, messages);
}

TEST(Outbox, HasItsLimits) {
  Outbox outbox({.waiting = 3, .sent = 2});
  put(outbox, 1, 3);
  EXPECT_FALSE(outbox.put("count", "4", false));
  outbox.connected();
  sent_by(outbox, 2);
  std::optional<OutgoingMessage> third;
  std::thread sender([&] { third = outbox.next(); });
  outbox.acknowledged(1);
  sender.join();
  EXPECT_EQ(third.value().payload, "3") << "as soon as there is room";
  std::thread last([&] { third = outbox.next(); });
  outbox.close();
  last.join();
  EXPECT_EQ(third, std::nullopt);
  EXPECT_TRUE(outbox.closed_within(1h));
}

TEST(Outbox, DropsWhatCanNeverBeSent) {
  Outbox outbox({});
  outbox.connected();
  put(outbox, 1, 1);
  outbox.withdraw(outbox.next()->number);
  outbox.disconnected();
  EXPECT_TRUE(outbox.drained(Outbox::Clock::now()));
}

}  // namespace
}  // namespace thermotwin::twin
