// A whole crossing in one program: a leader, a follower, and a radio between them that loses nothing.
#include <crossguard.hpp>
#include <queue>
#include <vector>

using namespace crossguard;

struct Packet { std::vector<std::uint8_t> octets; };
static std::optional<Robot> robots[2];
static Turn turns[2];
static std::queue<std::pair<int, std::variant<Event, Packet>>> queue; // who it is for, and what happens then
static std::optional<Maneuver> maneuver;
static std::optional<Notice> ended;

static void hear(const Notice &news) { // the leader's application
  switch (news.kind) {
  case CROSSGUARD_NOTICE_FOLLOWER_JOINED: queue.push({0, Event::command(news.station, Task::move)}); break;
  case CROSSGUARD_NOTICE_MANEUVER_REPORTED: queue.push({0, Event::open_corridor()}); break;
  // Only when nobody is on the road any more.
  case CROSSGUARD_NOTICE_MANEUVER_COMPLETED: queue.push({0, Event::task_completed()}); break;
  case CROSSGUARD_NOTICE_SESSION_ENDED: ended = news; break;
  default: break;
  }
}

static void carry_out(int who) {
  for (const Output &output : turns[who].outputs()) {
    if (auto send = output.as<Send>())
      queue.push({!who, Packet{{send->packet.data, send->packet.data + send->packet.size}}});
    else if (auto start = output.as<StartManeuver>())
      maneuver = start->maneuver; // the body goes
    else if (output.as<CorridorOpened>()) // people cross, and then their escort is done
      queue.push({1, Event::completed(*maneuver)});
    else if (auto news = output.as<Notice>(); news && who == 0)
      hear(*news);
  }
}

int main() {
  for (int who : {0, 1}) // boot counters: counted up, and on the disk before this
    robots[who] = Robot::start(Config{static_cast<std::uint32_t>(who + 1), 1, who ? "Go2" : "ARI"});
  queue.push({0, Event::pedestrian_detected(1, tasks(Task::move))});
  for (std::uint64_t ms = 0; ms < 10000 && !ended; ms += 20) {
    for (int who : {0, 1}) { // time first, then what happened in it
      turns[who].at(700000000000 + ms, ms * 1000);
      robots[who]->elapse(std::chrono::milliseconds{20}, turns[who]);
      carry_out(who);
    }
    for (; !queue.empty(); queue.pop()) {
      const auto &[who, what] = queue.front();
      if (auto event = std::get_if<Event>(&what)) robots[who]->tell(*event, turns[who]);
      else if (auto packet = std::get_if<Packet>(&what))
        robots[who]->receive({packet->octets.data(), packet->octets.size()}, turns[who]);
      carry_out(who);
    }
  }
  return ended && ended->why.reason == CROSSGUARD_REASON_TASK_COMPLETED ? 0 : 1;
}
