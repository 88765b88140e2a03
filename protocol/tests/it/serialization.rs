//! What is read back is what was written, and nothing is read that cannot be.
#![cfg(feature = "serde")]

use crossguard_protocol::*;

#[test]
fn a_list_is_its_items_and_no_more_than_it_holds() {
    let list: List<u8, 3> = [5, 6].into_iter().collect();
    let text = serde_json::to_string(&list).unwrap();
    assert_eq!(text, "[5,6]");
    assert_eq!(serde_json::from_str::<List<u8, 3>>(&text).unwrap(), list);
    assert_eq!(format!("{list:?}"), text.replace(',', ", "));
    assert!(serde_json::from_str::<List<u8, 3>>("[1,2,3]").is_ok());
    let too_long = serde_json::from_str::<List<u8, 3>>("[1,2,3,4]").unwrap_err();
    assert!(
        too_long
            .to_string()
            .starts_with("invalid length 4, expected at most 3 items"),
        "{too_long}"
    );
}

#[test]
fn a_configuration_is_its_settings_and_keeps_the_inequalities() {
    let settings = Settings {
        t_lease: Millis(1_500),
        ..Settings::default()
    };
    let config = Config::new(settings.clone()).unwrap();
    let text = serde_json::to_string(&config).unwrap();
    assert_eq!(text, serde_json::to_string(&settings).unwrap());
    assert_eq!(serde_json::from_str::<Config>(&text).unwrap(), config);
    let broken = text.replace("1500", "2000");
    let refused = serde_json::from_str::<Config>(&broken).unwrap_err();
    assert!(
        refused.to_string().contains("lease-within-safety"),
        "{refused}"
    );
}

#[test]
fn a_robot_in_the_middle_of_a_request_is_what_it_was() {
    let mut robot = Robot::new(StationId(1), 3);
    let request = HelpRequest {
        urgency: Urgency::Low,
        followers: 1,
        tasks: TaskSet::of(&[TaskType::BLOCK]),
        place: Place(3),
    };
    let detected = Input::Local(Event::PedestrianDetected(request));
    robot.step(&Config::default(), detected);
    let text = serde_json::to_string(&robot).unwrap();
    assert_eq!(serde_json::from_str::<Robot>(&text).unwrap(), robot);
}
