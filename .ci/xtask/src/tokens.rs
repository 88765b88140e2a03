//! Paths in source text: in `use`, in code, and in the tokens of macros.

use proc_macro2::{Ident, LineColumn, TokenStream, TokenTree};
use syn::ext::IdentExt;
use syn::{Path, UseTree};

/// A path in the source with the place where it begins.
#[derive(Clone, Debug)]
pub(crate) struct Named {
    pub(crate) segments: Vec<String>,
    pub(crate) at: LineColumn,
}

/// An identifier without `r#`.
pub(crate) fn name(ident: &Ident) -> String {
    ident.unraw().to_string()
}

pub(crate) fn path(path: &Path) -> Option<Named> {
    let first = path.segments.first()?;
    let is_local = path.leading_colon.is_none();
    is_local.then(|| Named {
        segments: path.segments.iter().map(|it| name(&it.ident)).collect(),
        at: first.ident.span().start(),
    })
}

/// What a `use` brings in.
pub(crate) struct Import {
    pub(crate) path: Named,
    pub(crate) brings: Brings,
}

pub(crate) enum Brings {
    /// One name.
    Name(String),
    /// All names of the path: `*`.
    All,
    /// Nothing but its traits: `as _`.
    Traits,
}

/// Everything that a `use` brings in.
pub(crate) fn imports(tree: &UseTree) -> Vec<Import> {
    let mut found = Vec::new();
    add(tree, &[], None, &mut found);
    found
}

fn add(tree: &UseTree, before: &[String], first: Option<LineColumn>, found: &mut Vec<Import>) {
    let mut push = |ident: Option<&Ident>, at: LineColumn, brings| {
        let last = ident
            .map(name)
            .filter(|last| last != "self" || before.is_empty());
        let segments = before.iter().cloned().chain(last).collect();
        let path = Named { segments, at };
        found.push(Import { path, brings });
    };
    match tree {
        UseTree::Path(it) => {
            let before: Vec<_> = before.iter().cloned().chain([name(&it.ident)]).collect();
            add(&it.tree, &before, Some(it.ident.span().start()), found);
        }
        UseTree::Name(it) => {
            let last = match name(&it.ident) {
                last if last == "self" => before.last().cloned().unwrap_or(last),
                last => last,
            };
            push(Some(&it.ident), it.ident.span().start(), Brings::Name(last));
        }
        UseTree::Rename(it) => {
            let brings = match name(&it.rename) {
                rename if rename == "_" => Brings::Traits,
                rename => Brings::Name(rename),
            };
            push(Some(&it.ident), it.ident.span().start(), brings);
        }
        UseTree::Glob(it) => {
            let at = first.unwrap_or_else(|| it.star_token.spans[0].start());
            push(None, at, Brings::All);
        }
        UseTree::Group(it) => {
            for tree in &it.items {
                add(tree, before, first, found);
            }
        }
    }
}

/// Everything in the tokens of a macro that looks like a path.
pub(crate) fn in_tokens(tokens: &TokenStream) -> Vec<Named> {
    let mut found: Vec<Named> = Vec::new();
    // The colons since the last identifier; nothing where another token came between.
    let mut colons = None;
    for token in tokens.clone() {
        match token {
            TokenTree::Ident(ident) => {
                match (colons, found.last_mut()) {
                    (Some(2), Some(last)) => last.segments.push(name(&ident)),
                    _ => found.push(Named {
                        segments: vec![name(&ident)],
                        at: ident.span().start(),
                    }),
                }
                colons = Some(0);
            }
            TokenTree::Punct(punct) if punct.as_char() == ':' => {
                colons = colons.map(|colons| colons + 1);
            }
            TokenTree::Group(group) => {
                found.extend(in_tokens(&group.stream()));
                colons = None;
            }
            TokenTree::Punct(_) | TokenTree::Literal(_) => colons = None,
        }
    }
    found
}

/// Paths in the text of an attribute, as in `with = "crate::view::bits"`.
pub(crate) fn in_strings(tokens: &TokenStream) -> Vec<Named> {
    let texts = tokens.clone().into_iter().filter_map(|token| {
        let TokenTree::Literal(literal) = token else {
            return None;
        };
        let at = literal.span().start();
        let text = literal.to_string();
        let parsed = syn::parse_str::<Path>(text.trim_matches('"')).ok()?;
        let named = path(&parsed)?;
        (named.segments.len() > 1).then_some(Named { at, ..named })
    });
    texts.collect()
}
