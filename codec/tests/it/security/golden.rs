//! Certificates and messages that another implementation made (pycrate's COER with the ECDSA of
//! RFC 6979), whose structure Wireshark agrees with.

use crossguard_codec::security::{
    Certificate, Duration, HashedId3, HashedId8, IssuePermission, Issuer, Permission, PrivateKey,
    SignedMessage, SignerIdentifier, Ssp, SspRange, Station, Subjects, Ticket, Time64, Tolerances,
    TrustStore, Validity, issue, issue::Terms,
};

use crate::support::from_hex;

const ROOT_KEY: &str = "4813494d137e1631bba301d5acab6e7bb7aa74ce1185d456565ef51d737677b3";
const ROOT: &str = "8003008100188109544553542d524f4f540000000000296823f186000301028002026e81\
    0201018002027081030201fe01018080010480012482080301fffc03ff00038002027e8204010101ff8002406082\
    04010101ff800240618204010101ff0102808082a88af0460aa6e1fb947fa57a78cff6132ade39dd53d1088a120f\
    d0c4912ba0b180807917322c5b489a7643475a1e0f3cca3b3a11bec7f201c145161450847f8de60a681051cedd0d\
    c0980654aa78eaee282fd44e74f6b2f7c14ad7d6f2b81f695a53";
const AUTHORITY: &str = "800300807e684ae3d090463c198107544553542d41410000000000296823f186000201\
    018002026f81030201c001010080010480012482080301fffc03ff00038002027e8204010101ff80024060820401\
    0101ff800240618204010101ff008082b464e01e761cd934ce6001432950ed240e57cb3c20b47e7f762badd91221\
    36c880808269ec2329725297d4d00cb714cea611140f20944bc1ce993d15dcc5145738da23808065676b5fe635a0\
    a2df7ea62cb3061a81db5cabababf15d4e223b9799dbd7b1fab307dd8ec021343796e4e61716286d7b2150ede545\
    993777ac8816df6f86c3af";
const AUTHORITY_KEY: &str = "961b6dd3ede3cb8ecbaacbd68de040cd78eb2ed5889130cceb4c49268ea4d507";
const TICKET: &str = "80030080e28e75df470bdf3210830000000000296823f18400a8010480012481040301000\
    08002027e8102010180024060810201018002406181020101808083b31993b4d7d3ad2e0f393460d00fec7ad6f87\
    81e410010a5df48b866b456556f8080936ce4563e4e7dd001f9d4c544a0b005a7b78d8893ad200c886bb15fd68c6\
    3d3821811d4c3bec50e8256dec6194c91da3095feac1ad6b0c6dee10efd06595b57";
const TICKET_KEY: &str = "b1d6b91b67c2afa5e322988d9462638d354ddf8a1ef79dba987f815c22b4baef";
/// What is signed in the messages: a CAM in a single-hop packet, behind the basic header.
const PAYLOAD: &str = "20500280003f01001400020000000001bf0353e81d1103b105702107856d038400000000\
    07d100000202075bcd153039605a56bd962e173e60e0c80647083d860c00384122b6b102908a8f33ffe1fffa0100\
    15ff9b8031d8ce000c4ffc8c01a38e714c";
const SIGNATURE: &str = "8080d7661d6e33143a0c62cbcbf934571795a4797d876a4ab53ae7307834163814480\
    6e253aba9b724af873915ba530e2e164cd116b828329cb2c02613f09337ee30";
/// Signed with a digest, and asking for certificate aabbcc.
const S3_TAIL: &str = "c00124000277d224ffc240020480050101aabbcc806d07c063fbbf552580802f9bd5d9b\
    f2abca0d5d3d479e4f8c11eae2edf2b6ee7bb89ead570723b9e76a48760b01612034a41a1e81e981e2c2936fc2c9\
    c6728c45909d4ffc86f7f890527";
const GENERATED: Time64 = Time64(694_694_401_000_000);
const CAM: u32 = 36;

fn certificate(hex: &str) -> Certificate {
    Certificate::decode(&from_hex(hex)).unwrap()
}

fn key(hex: &str) -> PrivateKey {
    PrivateKey::of_octets(&from_hex(hex).try_into().unwrap()).unwrap()
}

fn trust() -> TrustStore {
    let mut trust = TrustStore::default();
    trust.add_root(certificate(ROOT)).unwrap();
    trust.add_authority(certificate(AUTHORITY)).unwrap();
    trust
}

fn sender() -> Station {
    let ticket = Ticket::new(certificate(TICKET), key(TICKET_KEY)).unwrap();
    let before = Time64(GENERATED.0 - 600_000);
    Station::new(trust(), vec![ticket], Tolerances::default(), before).unwrap()
}

fn message(tail: &str) -> Vec<u8> {
    from_hex(&format!("03810040038063{PAYLOAD}{tail}"))
}

fn s1() -> Vec<u8> {
    message(&format!(
        "400124000277d224ffc240806d07c063fbbf5525{SIGNATURE}"
    ))
}

fn s2() -> Vec<u8> {
    message(&format!("400124000277d224ffc240810101{TICKET}{SIGNATURE}"))
}

#[test]
fn certificates_have_the_names_that_were_computed_elsewhere() {
    let id = |hex| certificate(hex).id().to_string();
    assert_eq!(id(ROOT), "7e684ae3d090463c");
    assert_eq!(id(AUTHORITY), "e28e75df470bdf32");
    assert_eq!(id(TICKET), "6d07c063fbbf5525");
    assert_eq!(
        certificate(TICKET).content().issuer,
        Issuer::Certificate(certificate(AUTHORITY).id())
    );
    assert_eq!(certificate(AUTHORITY).octets(), from_hex(AUTHORITY));
}

#[test]
fn the_same_messages_are_made() {
    let payload = from_hex(PAYLOAD);
    // The first message brings the certificate.
    assert_eq!(sender().seal(GENERATED, CAM, &payload), Ok(s2()));
    let mut sender = sender();
    sender
        .seal(Time64(GENERATED.0 - 600_000), CAM, &payload)
        .unwrap();
    assert_eq!(sender.seal(GENERATED, CAM, &payload), Ok(s1()));
}

#[test]
fn the_messages_are_believed() {
    let own = Ticket::new(other_ticket(), key(ROOT_KEY)).unwrap();
    let mut receiver = Station::new(trust(), vec![own], Tolerances::default(), GENERATED).unwrap();
    let s2 = s2();
    let message = SignedMessage::decode(&s2).unwrap();
    assert_eq!(message.payload, from_hex(PAYLOAD));
    assert_eq!(message.header.its_aid, CAM);
    assert_eq!(message.header.generation_time, GENERATED);
    let verified = receiver.verify(GENERATED, None, &message).unwrap();
    assert_eq!(verified.signer, certificate(TICKET).id());
    assert_eq!(verified.ssp, Ssp::Bitmap(vec![1, 0, 0]));

    let s3 = self::message(S3_TAIL);
    let message = SignedMessage::decode(&s3).unwrap();
    let requests: Vec<_> = message.header.requests().collect();
    assert_eq!(requests, [HashedId3([0xaa, 0xbb, 0xcc])]);
    assert_eq!(
        message.signer,
        SignerIdentifier::Digest(HashedId8(from_hex("6d07c063fbbf5525").try_into().unwrap()))
    );
    assert!(receiver.verify(GENERATED, None, &message).is_ok());
}

/// The ticket of a receiver.
fn other_ticket() -> Certificate {
    let terms = Terms {
        permissions: vec![bitmap(CAM, &[1, 0, 0])],
        ..ticket_terms()
    };
    let holder = key(ROOT_KEY).public_key();
    issue::ticket(&certificate(AUTHORITY), &key(AUTHORITY_KEY), holder, &terms).unwrap()
}

fn bitmap(its_aid: u32, bits: &[u8]) -> Permission {
    Permission {
        its_aid,
        ssp: Ssp::Bitmap(bits.to_vec()),
    }
}

fn valid_for(duration: Duration) -> Validity {
    Validity {
        start: 694_690_801,
        duration,
    }
}

fn ticket_terms() -> Terms {
    let permissions = vec![
        bitmap(CAM, &[1, 0, 0]),
        bitmap(638, &[1]),
        bitmap(16_480, &[1]),
        bitmap(16_481, &[1]),
    ];
    Terms::of_ticket(valid_for(Duration::hours(168)), permissions)
}

#[test]
fn the_same_certificates_are_issued() {
    let version_one = |its_aid| {
        let range = SspRange::Bitmap {
            value: vec![1],
            mask: vec![0xff],
        };
        (its_aid, range)
    };
    let cam = SspRange::Bitmap {
        value: vec![1, 0xff, 0xfc],
        mask: vec![0xff, 0, 3],
    };
    let these = vec![
        (CAM, cam),
        version_one(638),
        version_one(16_480),
        version_one(16_481),
    ];
    let root = Terms {
        name: Some("TEST-ROOT".to_owned()),
        issue_permissions: vec![IssuePermission {
            subjects: Subjects::These(these),
            min_chain_length: 2,
            chain_length_range: 0,
            for_applications: true,
        }],
        ..Terms::of_ticket(
            valid_for(Duration::years(3)),
            vec![bitmap(622, &[1]), bitmap(624, &[1, 0xfe])],
        )
    };
    assert_eq!(
        issue::root(&key(ROOT_KEY), &root).unwrap(),
        certificate(ROOT)
    );
    let holder = key(TICKET_KEY).public_key();
    let ticket = issue::ticket(
        &certificate(AUTHORITY),
        &key(AUTHORITY_KEY),
        holder,
        &ticket_terms(),
    );
    assert_eq!(ticket.unwrap(), certificate(TICKET));
}
