//! Keys in a token that speaks PKCS#11: they are made there, sign there, and do not leave it.

use std::fmt;
use std::path::Path;
use std::sync::{Arc, Mutex, PoisonError};

use crossguard_codec::security::{KeyFailure, PublicKey, Signature, SigningKey};
use cryptoki::context::{CInitializeArgs, CInitializeFlags, Pkcs11};
use cryptoki::error::{Error, RvError};
use cryptoki::mechanism::Mechanism;
use cryptoki::object::{Attribute, AttributeType, ObjectClass, ObjectHandle};
use cryptoki::session::{Session, UserType};
use cryptoki::types::AuthPin;

/// `prime256v1`, which is NIST P-256, as an object identifier in DER.
const NIST_P256: [u8; 10] = [6, 8, 0x2a, 0x86, 0x48, 0xce, 0x3d, 3, 1, 7];

/// Before the 65 octets of a point in DER: an octet string of that length.
const POINT: [u8; 2] = [4, 65];

/// A token that is logged in to.
pub(crate) struct Token(Arc<Mutex<Session>>);

/// A key pair in a token.
pub(crate) struct TokenKey {
    session: Arc<Mutex<Session>>,
    private: ObjectHandle,
    public: PublicKey,
}

/// Why a token, or a key in it, cannot be used.
#[derive(Debug, thiserror::Error)]
pub(crate) enum TokenError {
    /// The module or the token says no.
    #[error("{0}")]
    Pkcs11(#[from] Error),
    /// There is no such token.
    #[error("no token is labelled '{0}'; 'softhsm2-util --show-slots' lists those of SoftHSM")]
    NoToken(String),
    /// What has the label is no key pair of NIST P-256.
    #[error("'{0}' in the token is no key pair of NIST P-256")]
    OtherKey(String),
}

impl Token {
    /// The token with this label, by this module of PKCS#11.
    ///
    /// # Errors
    /// When there is none, or the PIN is wrong.
    pub(crate) fn open(module: &Path, label: &str, pin: &AuthPin) -> Result<Self, TokenError> {
        let pkcs11 = Pkcs11::new(module)?;
        pkcs11.initialize(CInitializeArgs::new(CInitializeFlags::OS_LOCKING_OK))?;
        for slot in pkcs11.get_slots_with_initialized_token()? {
            if pkcs11.get_token_info(slot)?.label() == label {
                let session = pkcs11.open_rw_session(slot)?;
                session.login(UserType::User, Some(pin))?;
                return Ok(Self(Arc::new(Mutex::new(session))));
            }
        }
        Err(TokenError::NoToken(label.to_owned()))
    }

    /// The key pair with this label, which is made if there is none.
    ///
    /// # Errors
    /// When the token cannot make it, or something else has the label.
    pub(crate) fn key(&self, label: &str) -> Result<TokenKey, TokenError> {
        let session = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let find = |class| {
            let wanted = [
                Attribute::Class(class),
                Attribute::Label(label.as_bytes().to_vec()),
            ];
            session.find_objects(&wanted)
        };
        let there = find(ObjectClass::PRIVATE_KEY)?;
        let (public, private) = match (&find(ObjectClass::PUBLIC_KEY)?[..], &there[..]) {
            ([public], [private]) => (*public, *private),
            ([], []) => generate(&session, label)?,
            _ => return Err(TokenError::OtherKey(label.to_owned())),
        };
        let attributes = session.get_attributes(public, &[AttributeType::EcPoint])?;
        let key = attributes.iter().find_map(|attribute| match attribute {
            Attribute::EcPoint(octets) => PublicKey::of_sec1(octets.strip_prefix(&POINT)?),
            _ => None,
        });
        Ok(TokenKey {
            session: Arc::clone(&self.0),
            private,
            public: key.ok_or_else(|| TokenError::OtherKey(label.to_owned()))?,
        })
    }

    /// Ends the login: no key signs any more.
    ///
    /// # Errors
    /// When the token is gone.
    pub(crate) fn log_out(&self) -> Result<(), TokenError> {
        let session = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        Ok(session.logout()?)
    }
}

/// Makes a key pair whose private key cannot be read, by nobody.
fn generate(session: &Session, label: &str) -> Result<(ObjectHandle, ObjectHandle), Error> {
    let label = Attribute::Label(label.as_bytes().to_vec());
    let public = [
        Attribute::Token(true),
        Attribute::Private(false),
        Attribute::Verify(true),
        Attribute::EcParams(NIST_P256.to_vec()),
        label.clone(),
    ];
    let private = [
        Attribute::Token(true),
        Attribute::Private(true),
        Attribute::Sensitive(true),
        Attribute::Extractable(false),
        Attribute::Sign(true),
        label,
    ];
    session.generate_key_pair(&Mechanism::EccKeyPairGen, &public, &private)
}

impl TokenKey {
    /// Whether the token gives the private key away.
    ///
    /// # Errors
    /// When the token is gone.
    pub(crate) fn can_be_read(&self) -> Result<bool, TokenError> {
        let session = self.session.lock().unwrap_or_else(PoisonError::into_inner);
        let value = session.get_attributes(self.private, &[AttributeType::Value])?;
        Ok(!value.is_empty())
    }
}

impl fmt::Debug for TokenKey {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("TokenKey")
    }
}

impl SigningKey for TokenKey {
    fn public_key(&self) -> PublicKey {
        self.public
    }

    fn sign(&self, digest: &[u8; 32]) -> Result<Signature, KeyFailure> {
        let session = self.session.lock().unwrap_or_else(PoisonError::into_inner);
        let signed = session.sign(&Mechanism::Ecdsa, self.private, digest);
        let octets = signed.map_err(|error| KeyFailure(why(&error)))?;
        let octets = <[u8; 64]>::try_from(octets).ok();
        let signature = octets.and_then(|octets| Signature::of_octets(&octets));
        signature.ok_or(KeyFailure("the token's signature is none"))
    }
}

const fn why(error: &Error) -> &'static str {
    match error {
        // Without a login, SoftHSM knows no private key.
        Error::Pkcs11(
            RvError::UserNotLoggedIn | RvError::KeyHandleInvalid | RvError::ObjectHandleInvalid,
            _,
        ) => "nobody is logged in to the token",
        Error::Pkcs11(
            RvError::DeviceRemoved | RvError::TokenNotPresent | RvError::SessionHandleInvalid,
            _,
        ) => "the token was removed",
        _ => "the token refused",
    }
}
