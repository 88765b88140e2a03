//! The type assignments of the modules, as the parser of rasn-compiler reads them.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::fs;
use std::rc::Rc;

use rasn_compiler::prelude::ir::{
    ASN1Type, Constraint, ElementOrSetOperation, SubtypeElements, ToplevelTypeDefinition,
};
use rasn_compiler::prelude::*;

/// One module in `asn1`.
pub(crate) struct Module {
    /// Its name without `Crossguard-`.
    pub(crate) name: &'static str,
    /// The comment at its beginning.
    pub(crate) about: String,
    /// Its type assignments, in their order.
    pub(crate) types: Vec<ToplevelTypeDefinition>,
}

/// A backend of rasn-compiler that keeps what it is given.
#[derive(Default)]
struct Collector(Rc<RefCell<Vec<ToplevelTypeDefinition>>>);

impl Backend for Collector {
    type Config = ();

    const FILE_EXTENSION: &'static str = "";

    fn generate_module(
        &mut self,
        declarations: Vec<ToplevelDefinition>,
    ) -> Result<GeneratedModule, GeneratorError> {
        let types = declarations
            .into_iter()
            .map(|declaration| match declaration {
                ToplevelDefinition::Type(definition) => definition,
                other => panic!("{} is no type", other.name()),
            });
        self.0.borrow_mut().extend(types);
        Ok(GeneratedModule::empty())
    }

    fn generate(&self, _: ToplevelDefinition) -> Result<String, GeneratorError> {
        Ok(String::new())
    }

    fn config(&self) -> &() {
        &()
    }

    fn from_config((): ()) -> Self {
        Self::default()
    }

    fn new((): (), _: TaggingEnvironment, _: ExtensibilityEnvironment) -> Self {
        Self::default()
    }
}

/// All modules, in the order of their imports.
pub(crate) fn parse() -> Vec<Module> {
    let collected = Rc::default();
    let result = Compiler::<RasnBackend, _>::new()
        .with_backend(Collector(Rc::clone(&collected)))
        .add_asn_sources_by_path(super::module_paths().iter())
        .compile_to_string()
        .expect("the modules compile");
    assert!(result.warnings.is_empty(), "{:?}", result.warnings);
    let mut types: BTreeMap<String, Vec<ToplevelTypeDefinition>> = BTreeMap::new();
    for definition in collected.take() {
        let header = definition.module_header.as_ref().expect("a module");
        let module = header.borrow().name.clone();
        types.entry(module).or_default().push(definition);
    }
    let paths = super::module_paths();
    let modules = super::MODULES.into_iter().zip(paths).map(|(name, path)| {
        let text = fs::read_to_string(path).expect("the module can be read");
        let mut types = types.remove(&format!("Crossguard-{name}")).expect("types");
        // The compiler sorts by name, and drops the comment behind a BOOLEAN.
        types.sort_by_key(|definition| position(&text, definition));
        for definition in &mut types {
            definition.comments = comment_before(&text[..position(&text, definition)]);
        }
        let about = text.lines().map_while(|line| line.strip_prefix("-- "));
        Module {
            name,
            about: about.collect::<Vec<_>>().join(" "),
            types,
        }
    });
    modules.collect()
}

/// Where a type is assigned in the text of its module.
fn position(text: &str, definition: &ToplevelTypeDefinition) -> usize {
    let assignment = format!("\n{} ::=", definition.name);
    text.find(&assignment).expect("the assignment") + 1
}

/// The comment at the end of `text`, in one line.
fn comment_before(text: &str) -> String {
    let lines = text.lines().rev();
    let comment = lines.map_while(|line| line.strip_prefix("-- "));
    let mut comment: Vec<_> = comment.collect();
    comment.reverse();
    comment.join(" ")
}

/// The smallest and the largest number or size that constraints leave, and whether there are others
/// behind an extension marker.
pub(crate) fn range(constraints: &[Constraint]) -> (i64, i64, bool) {
    let range = ir::per_visible_range_constraints(true, constraints).expect("a range");
    let min = range.min().expect("a lower bound");
    let max = range.max().expect("an upper bound");
    (min, max, range.is_extensible())
}

/// The name that a type has, if it is not written out where it is used.
pub(crate) fn reference(ty: &ASN1Type) -> Option<&str> {
    match ty {
        ASN1Type::ElsewhereDeclaredType(declaration) => Some(&declaration.identifier),
        _ => None,
    }
}

/// The alternatives that an inner subtype constraint says to be absent.
pub(crate) fn absent<'a>(
    constraints: impl IntoIterator<Item = &'a Constraint>,
) -> impl Iterator<Item = &'a str> {
    let inner = constraints
        .into_iter()
        .filter_map(|constraint| match constraint {
            Constraint::Subtype(specs) => match &specs.set {
                ElementOrSetOperation::Element(SubtypeElements::MultipleTypeConstraints(inner)) => {
                    Some(inner)
                }
                _ => None,
            },
            _ => None,
        });
    let named = inner.flat_map(|inner| &inner.constraints);
    named
        .filter(|named| named.presence == ir::ComponentPresence::Absent)
        .map(|named| named.identifier.as_str())
}
