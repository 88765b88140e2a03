//! The types of rasn: what rasn-compiler makes of the modules, corrected.

use rasn_compiler::prelude::*;

const HEADER: &str = "//! Generated from `asn1/*.asn` by `tests/generated`; do not edit.";

/// The file with all modules.
pub(crate) fn generate() -> String {
    correct(&compile())
}

/// What rasn-compiler makes of the modules, as it stands.
fn compile() -> String {
    let derive = "#[derive(AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, \
                  Deserialize)]";
    let config = RasnConfig {
        type_annotations: vec![derive.into()],
        custom_imports: vec!["serde::{Deserialize, Serialize}".into()],
        ..RasnConfig::default()
    };
    let paths = super::module_paths();
    let result = Compiler::<RasnBackend, _>::new_with_config(config)
        .add_asn_sources_by_path(paths.iter())
        .compile_to_string()
        .expect("the modules compile");
    assert!(result.warnings.is_empty(), "{:?}", result.warnings);
    result.generated
}

/// Corrects what rasn-compiler gets wrong, and adds what it has no option for.
fn correct(generated: &str) -> String {
    // An inner subtype constraint becomes a value constraint that it is not.
    let generated = generated.replace("value(\"0..\"), identifier", "identifier");
    // rasn forgets the size of a list that is an extension addition.
    let generated = generated.replace(
        "extension_addition, identifier = \"extensionContainers\"",
        "extension_addition, size(\"1..=8\", extensible), identifier = \"extensionContainers\"",
    );
    let mut corrected = vec![HEADER.to_owned()];
    let mut lines = generated.lines();
    while let Some(line) = lines.next() {
        if line.contains("#[doc = \"") {
            corrected.extend(doc_comment(line));
            continue;
        }
        let mut item = line.to_owned();
        if line.trim() == "#[rasn(" {
            // An attribute over several lines.
            let rest = lines.by_ref().take_while(|line| line.trim() != ")]");
            item = rest.fold(item, |item, line| item + "\n" + line) + "\n        )]";
        }
        let rename = identifier(&item).map(|name| format!("        #[serde(rename = \"{name}\")]"));
        // A component with a DEFAULT may be left out in JSON as well.
        let default = default(&item).map(|name| format!("        #[serde(default = \"{name}\")]"));
        corrected.push(with_serde_view(&item));
        corrected.extend(rename);
        corrected.extend(default);
    }
    corrected.join("\n") + "\n"
}

/// Names the serde view of types of rasn that have none of their own.
fn with_serde_view(item: &str) -> String {
    let views = [
        ("FixedBitString<", "fixed_bits"),
        ("BitString)", "bits"),
        ("Integer)", "integer"),
        ("OctetString)", "octets"),
    ];
    for (inner, view) in views {
        if let Some((start, end)) = item.split_once(&format!("(pub {inner}")) {
            return format!(
                "{start}(#[serde(with = \"crate::asn1::view::{view}\")] pub {inner}{end}"
            );
        }
    }
    item.to_owned()
}

/// A doc attribute as a comment; nothing for the headings of the modules' sections.
fn doc_comment(line: &str) -> Option<String> {
    let (indent, doc) = line.split_once("#[doc = \"")?;
    let text = doc.strip_suffix("\"]")?;
    (!text.starts_with(" == ")).then(|| format!("{indent}///{text}"))
}

/// The ASN.1 identifier that an attribute names.
fn identifier(item: &str) -> Option<&str> {
    let (_, name) = item.split_once("identifier = \"")?;
    name.split('"').next()
}

/// The function with the DEFAULT of a component.
fn default(item: &str) -> Option<&str> {
    let (_, name) = item.split_once("default = \"")?;
    name.split('"').next()
}
