//! Lists of up to four numbers: all lists.

use crossguard_protocol::laws::lists::{self as laws, Numbers};

use crate::harness::harnesses;
use crate::kani;

fn any_list() -> Numbers {
    let length: usize = usize::from(kani::any::<u8>() % 5);
    laws::numbers(kani::any(), length)
}

harnesses! {
    /// All lists.
    #[unwind(6)]
    fn a_list_holds_what_it_was_made_of() {
        let length = usize::from(kani::any::<u8>() % 5);
        laws::holds_what_it_was_made_of(kani::any(), length);
        kani::cover!(length == 0, "empty");
        kani::cover!(length == 4, "full");
    }

    /// All lists and items.
    #[unwind(6)]
    fn a_push_appends() {
        let (list, item) = (any_list(), kani::any());
        laws::pushes_to_the_end(list, item);
        kani::cover!(list.len() == 4, "full");
        kani::cover!(list.is_empty(), "empty");
    }

    /// All lists and items.
    #[unwind(6)]
    fn a_removal_closes_the_gap() {
        let (list, item) = (any_list(), kani::any());
        laws::removes_the_first(list, item);
        kani::cover!(list.iter().any(|&present| present == item), "removed");
        kani::cover!(!list.iter().any(|&present| present == item), "not there");
    }

    /// All sorted lists and items.
    #[unwind(8)]
    fn a_ranked_insertion_keeps_the_best() {
        let (list, item) = (any_list(), kani::any());
        laws::inserts_by_rank(list, item);
        kani::cover!(list.len() == 4, "full");
        kani::cover!(list.is_empty(), "empty");
    }

    /// All slots.
    #[unwind(6)]
    fn a_list_is_dense_without_gaps() {
        let slots = kani::any::<[u8; 4]>().map(|slot| (slot % 2 == 1).then_some(slot));
        laws::tells_of_gaps(slots);
        kani::cover!(slots[0].is_none() && slots[2].is_some(), "a gap");
        kani::cover!(slots[3].is_some(), "full");
    }

    /// Up to four outputs.
    #[random_only("a list of outputs is most of a step")]
    fn outputs_hold_one_ram() {
        let rams = kani::any::<[u8; 4]>().map(|ram| ram % 2 == 1);
        laws::outputs_hold_one_ram(rams, usize::from(kani::any::<u8>() % 5));
        kani::cover!(rams == [true; 4], "all the same");
    }
}
