//! x

use crossguard_codec::core::{ram::RobotStatusContainer as T,cdd::{ItsPduHeader,BasicContainer}, decode, laws, max_octets};

use super::{any_octets, any_value};
use crate::harness::harnesses;
use crate::kani;

harnesses! {
    /// Any value.
    #[unwind(7)]
    #[solver(cadical)]
    fn a_value() {
        const N: usize = max_octets::<T>();
        let value: T = any_value();
        laws::encode_then_decode_is_identity::<T, N>(&value);
        kani::cover!(value.unavailability.is_some(), "present");
    }
    /// Any octets.
    #[unwind(7)]
    #[solver(cadical)]
    fn a_total() {
        const N: usize = max_octets::<T>();
        let octets: [u8; N] = any_octets::<T, N>();
        let length = usize::from(kani::any::<u8>()) % (N + 1);
        laws::decode_is_total::<T>(&octets[..length]);
        kani::cover!(length == 1, "present");
    }
    /// Any octets.
    #[unwind(7)]
    #[solver(cadical)]
    fn a_canonical() {
        const N: usize = max_octets::<T>();
        let octets: [u8; N] = any_octets::<T, N>();
        let length = usize::from(kani::any::<u8>()) % (N + 1);
        laws::decode_then_encode_is_identity::<T, N>(&octets[..length]);
        kani::cover!(decode::<T>(&octets[..length]).is_ok(), "present");
    }
    /// Any value.
    #[unwind(7)]
    #[solver(cadical)]
    fn h_value() {
        const N: usize = max_octets::<ItsPduHeader>();
        let value: ItsPduHeader = any_value();
        laws::encode_then_decode_is_identity::<ItsPduHeader, N>(&value);
        kani::cover!(value.station_id.0==1, "present");
    }
    /// Any value.
    #[unwind(20)]
    #[solver(cadical)]
    fn b_value() {
        const N: usize = max_octets::<BasicContainer>();
        let value: BasicContainer = any_value();
        laws::encode_then_decode_is_identity::<BasicContainer, N>(&value);
        kani::cover!(value.station_type.0==1, "present");
    }
    /// Any octets.
    #[unwind(20)]
    #[solver(cadical)]
    fn b_total() {
        const N: usize = max_octets::<BasicContainer>();
        let octets: [u8; N] = any_octets::<BasicContainer, N>();
        let length = usize::from(kani::any::<u8>()) % (N + 1);
        laws::decode_is_total::<BasicContainer>(&octets[..length]);
        kani::cover!(length == 1, "present");
    }
    /// Any octets.
    #[unwind(20)]
    #[solver(cadical)]
    fn b_canonical() {
        const N: usize = max_octets::<BasicContainer>();
        let octets: [u8; N] = any_octets::<BasicContainer, N>();
        let length = usize::from(kani::any::<u8>()) % (N + 1);
        laws::decode_then_encode_is_identity::<BasicContainer, N>(&octets[..length]);
        kani::cover!(decode::<BasicContainer>(&octets[..length]).is_ok(), "present");
    }
}
