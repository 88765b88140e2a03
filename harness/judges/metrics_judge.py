"""What Prometheus's own parser makes of the metrics of this kit, which come on standard input.

    prometheus_client (Apache-2.0)
"""

import sys

from prometheus_client.parser import text_string_to_metric_families


def main():
    families = {it.name: it for it in text_string_to_metric_families(sys.stdin.read())}
    kinds = {
        "crossguard_robot_info": "gauge",
        "crossguard_state": "gauge",
        "crossguard_role": "gauge",
        "crossguard_followers": "gauge",
        "crossguard_corridor_open": "gauge",
        "crossguard_on_duty": "gauge",
        "crossguard_link_info": "gauge",
        "crossguard_steps": "counter",
        "crossguard_messages": "counter",
        "crossguard_stations_heard": "gauge",
        "crossguard_around": "gauge",
        "crossguard_around_nearest_metres": "gauge",
        "crossguard_around_oldest_seconds": "gauge",
        "crossguard_without_effect": "counter",
    }
    assert {name: it.type for name, it in families.items()} == kinds, families.keys()
    for family in families.values():
        assert family.documentation, family.name
        labels = [tuple(sorted(sample.labels.items())) for sample in family.samples]
        assert len(set(labels)) == len(labels), f"{family.name} has a value twice"
        for sample in family.samples:
            assert sample.labels["robot"] == "ARI" and sample.value >= 0, sample
    for one_of in ("crossguard_state", "crossguard_role"):
        assert sum(sample.value for sample in families[one_of].samples) == 1, one_of
    causes = families["crossguard_without_effect"].samples
    assert any(sample.labels["layer"] == "protocol" for sample in causes), causes
    for sample in causes:
        assert sample.labels["cause"], sample
    messages = {(s.labels["direction"], s.labels["message"]): s.value
                for s in families["crossguard_messages"].samples}
    assert messages[("sent", "RAM")] > 0 and messages[("heard", "RAM")] > 0, messages
    assert families["crossguard_steps"].samples[0].value > 0
    print(f"prometheus_client reads {sum(len(it.samples) for it in families.values())} values"
          f" of {len(families)} families", file=sys.stderr)


main()
