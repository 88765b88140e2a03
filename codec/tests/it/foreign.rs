//! rasn's decoders on arbitrary and mutated octets: they neither panic nor take much memory, and what they
//! take can be encoded, put on the map and told to people.

use std::env;

use allocation_counter::measure;
use crossguard_codec::MESSAGE_LEN_MAX;
use crossguard_codec::its::ItsMessage;

use crate::support::core::{Random, mutate};
use crate::support::{canonical, its_vectors};
use crossguard_codec::core::Source as _;

/// How many inputs there are for each vector: by this variable, or so many.
const INPUTS: (&str, u64) = ("CROSSGUARD_FUZZ_INPUTS", 400);

/// No message takes more octets of heap at once, while it is decoded and told.
const HEAP_MAX: u64 = 8 * 1024 * 1024;

/// The vector with some bits and its end changed, or its header with noise behind it, sparse or dense.
fn input(vector: &[u8], random: &mut Random) -> Vec<u8> {
    match random.index(0, 3) {
        0 => mutate(vector.to_vec(), random),
        1 => {
            let kept = random.index(2, vector.len());
            let noise = random.index(0, MESSAGE_LEN_MAX - kept);
            [&vector[..kept], &random.octets(noise)].concat()
        }
        2 => {
            let noise = random.index(0, MESSAGE_LEN_MAX - 6);
            let dense = (0..noise).map(|_| random.octets(1)[0] | random.octets(1)[0]);
            let dense: Vec<u8> = dense.collect();
            [&vector[..6], &dense].concat()
        }
        _ => (0..8).fold(vector.to_vec(), |octets, _| match octets.len() {
            0 => octets,
            _ => mutate(octets, random),
        }),
    }
}

#[test]
fn no_octets_make_a_message_that_panics_or_takes_much_memory() {
    let inputs = env::var(INPUTS.0).map_or(INPUTS.1, |inputs| inputs.parse().unwrap());
    let (mut read, mut not_canonical, mut refused, mut heap_max) = (0_u64, 0_u64, 0_u64, 0);
    for (place, (name, identifiers, vector)) in its_vectors().enumerate() {
        let mut random = Random(place as u64);
        for _ in 0..inputs {
            let octets = input(&vector, &mut random);
            let mut received = None;
            let heap = measure(|| {
                received = ItsMessage::decode(&identifiers, &octets).ok();
                if let Some(received) = &received {
                    let _ = received.message.road_users(694_694_401_000);
                }
            });
            heap_max = heap_max.max(heap.bytes_max);
            assert!(heap.bytes_max < HEAP_MAX, "{name}: {octets:02x?}");
            match received {
                None => refused += 1,
                Some(received) => {
                    read += 1;
                    not_canonical += u64::from(!received.is_canonical);
                    canonical(&identifiers, &octets).unwrap();
                }
            }
        }
    }
    println!(
        "{read} read, {not_canonical} of them not canonical; {refused} refused; {heap_max} octets of heap at most"
    );
    assert!(read > 0 && not_canonical > 0 && refused > 0);
}
