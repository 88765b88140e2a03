// Topics as ROS 2 has them on DDS, by Cyclone DDS: names begin with rt/, types are package::msg::dds_::Name_, data is
// plain CDR, nobody waits for a reader.
#ifndef CROSSGUARD_DDS_DDS_HPP
#define CROSSGUARD_DDS_DDS_HPP

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

#include "crossguard_msgs.h"
#include "dds/dds.h"

namespace ros {

using Command = crossguard_msgs_msg_dds__Command_;
using Corridor = crossguard_msgs_msg_dds__Corridor_;
using Event = crossguard_msgs_msg_dds__Event_;
using Status = crossguard_msgs_msg_dds__Status_;
using Follower = crossguard_msgs_msg_dds__Follower_;
using Session = crossguard_msgs_msg_dds__Session_;
using Header = std_msgs_msg_dds__Header_;
using PoseStamped = geometry_msgs_msg_dds__PoseStamped_;
using DiagnosticArray = diagnostic_msgs_msg_dds__DiagnosticArray_;
using DiagnosticStatus = diagnostic_msgs_msg_dds__DiagnosticStatus_;
using KeyValue = diagnostic_msgs_msg_dds__KeyValue_;

template <class Message> const dds_topic_descriptor_t &type();
template <> inline const dds_topic_descriptor_t &type<Command>() { return crossguard_msgs_msg_dds__Command__desc; }
template <> inline const dds_topic_descriptor_t &type<Corridor>() { return crossguard_msgs_msg_dds__Corridor__desc; }
template <> inline const dds_topic_descriptor_t &type<Event>() { return crossguard_msgs_msg_dds__Event__desc; }
template <> inline const dds_topic_descriptor_t &type<Status>() { return crossguard_msgs_msg_dds__Status__desc; }
template <> inline const dds_topic_descriptor_t &type<PoseStamped>() { return geometry_msgs_msg_dds__PoseStamped__desc; }
template <> inline const dds_topic_descriptor_t &type<DiagnosticArray>() {
  return diagnostic_msgs_msg_dds__DiagnosticArray__desc;
}

// Something that DDS does not do.
struct Error : std::runtime_error {
  Error(const std::string &what, dds_return_t code)
      : std::runtime_error{what + ": " + dds_strretcode(code < 0 ? code : -code)} {}
};

inline dds_entity_t checked(dds_entity_t entity, const std::string &what) {
  if (entity < 0) throw Error{what, entity};
  return entity;
}

struct Qos {
  int depth = 10;
  dds_duration_t deadline = DDS_INFINITY;
  bool is_reliable = true;

  std::unique_ptr<dds_qos_t, void (*)(dds_qos_t *)> make() const {
    std::unique_ptr<dds_qos_t, void (*)(dds_qos_t *)> qos{dds_create_qos(), dds_delete_qos};
    // A write waits for no reader: what cannot be taken at once was not delivered.
    dds_qset_reliability(qos.get(), is_reliable ? DDS_RELIABILITY_RELIABLE : DDS_RELIABILITY_BEST_EFFORT, 0);
    dds_qset_durability(qos.get(), DDS_DURABILITY_VOLATILE);
    dds_qset_history(qos.get(), DDS_HISTORY_KEEP_LAST, depth);
    dds_qset_deadline(qos.get(), deadline);
    const dds_data_representation_id_t plain[] = {DDS_DATA_REPRESENTATION_XCDR1};
    dds_qset_data_representation(qos.get(), 1, plain);
    return qos;
  }
};

template <class Message> class Writer {
public:
  Writer(dds_entity_t participant, const std::string &topic, const Qos &qos) {
    const auto plain = qos.make();
    const auto made = checked(dds_create_topic(participant, &type<Message>(), topic.c_str(), nullptr, nullptr), topic);
    writer_ = checked(dds_create_writer(participant, made, plain.get(), nullptr), topic);
  }
  // Waits until the readers that are there have taken all of it, for this long at most.
  void settle(dds_duration_t at_most) const { (void)dds_wait_for_acks(writer_, at_most); }
  // Whether it was taken.
  bool write(const Message &message) const { return dds_write(writer_, &message) == DDS_RETCODE_OK; }
  // Whether the participant with this handle has a reader of it.
  bool is_heard_by(dds_instance_handle_t participant) const {
    std::array<dds_instance_handle_t, 64> readers;
    const auto count = dds_get_matched_subscriptions(writer_, readers.data(), readers.size());
    for (dds_return_t nth = 0; nth < count && nth < static_cast<dds_return_t>(readers.size()); ++nth) {
      auto *reader = dds_get_matched_subscription_data(writer_, readers[static_cast<std::size_t>(nth)]);
      if (!reader) continue;
      const bool is_it = reader->participant_instance_handle == participant;
      dds_builtintopic_free_endpoint(reader);
      if (is_it) return true;
    }
    return false;
  }

private:
  dds_entity_t writer_;
};

template <class Message> class Reader {
public:
  Reader(dds_entity_t participant, const std::string &topic, const Qos &qos, const dds_listener_t *listener) {
    const auto plain = qos.make();
    const auto made = checked(dds_create_topic(participant, &type<Message>(), topic.c_str(), nullptr, nullptr), topic);
    reader_ = checked(dds_create_reader(participant, made, plain.get(), listener), topic);
  }
  // Takes what has come: each message with the handle of its writer.
  template <class Hear> void take(Hear hear) const {
    std::array<void *, 32> loaned{};
    std::array<dds_sample_info_t, 32> infos;
    const auto count = dds_take(reader_, loaned.data(), infos.data(), loaned.size(), loaned.size());
    for (dds_return_t nth = 0; nth < count; ++nth) {
      const auto at = static_cast<std::size_t>(nth);
      if (infos[at].valid_data) hear(*static_cast<const Message *>(loaned[at]), infos[at].publication_handle);
    }
    if (count > 0) (void)dds_return_loan(reader_, loaned.data(), count);
  }
  // The participant of a writer; nothing if the writer is gone.
  std::optional<dds_instance_handle_t> participant_of(dds_instance_handle_t writer) const {
    auto *endpoint = dds_get_matched_publication_data(reader_, writer);
    if (!endpoint) return std::nullopt;
    const auto participant = endpoint->participant_instance_handle;
    dds_builtintopic_free_endpoint(endpoint);
    return participant;
  }
  // How many writers were not heard for their quality of service since this was asked last.
  std::uint32_t incompatible() const {
    dds_requested_incompatible_qos_status_t status{};
    if (dds_get_requested_incompatible_qos_status(reader_, &status) != DDS_RETCODE_OK) return 0;
    return static_cast<std::uint32_t>(status.total_count_change);
  }

private:
  dds_entity_t reader_;
};

} // namespace ros

#endif // CROSSGUARD_DDS_DDS_HPP
