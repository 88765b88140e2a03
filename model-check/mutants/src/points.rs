//! The places of the protocol that can be changed, and how the changed source reads.

use std::fmt;
use std::ops::Range;
use std::path::{Path, PathBuf};

use syn::spanned::Spanned;
use syn::visit::{self, Visit};

use crate::Failure;

/// Functions that constants of the workspace are made by: they stay `const`, and so have no mutants, which
/// read a variable. All other functions of the copy are not `const`.
pub(crate) const IN_CONSTANTS: [&str; 5] = ["new", "of", "color", "look", "capacity"];

/// The files that hold rules. What is left out shows states to people, brings the checker's states to
/// one form, says which states are valid, or states laws: nothing that a robot does.
const FILES: [&str; 17] = [
    "config",
    "corridor",
    "help",
    "id",
    "identity",
    "idle",
    "list",
    "maneuver",
    "message",
    "output",
    "robot",
    "roles",
    "state",
    "task",
    "termination",
    "time",
    "timers",
];

/// Traits whose functions only show or compare.
const SHOWN: [&str; 5] = ["Display", "Debug", "Clone", "Error", "Write"];

/// How many characters of source the text of a mutant has at most.
const TEXT_MAX: usize = 100;

/// One change of the protocol.
#[derive(Clone, Debug)]
pub(crate) struct Mutant {
    pub(crate) number: usize,
    pub(crate) file: &'static str,
    pub(crate) line: usize,
    pub(crate) function: String,
    pub(crate) change: String,
    /// Its number among the points that read the same, from 1.
    pub(crate) nth: usize,
}

impl Mutant {
    /// What a mutant is, without its number and line: no two are the same.
    pub(crate) fn key(&self) -> String {
        let Self {
            file,
            function,
            change,
            nth,
            ..
        } = self;
        let which = match nth {
            1 => String::new(),
            _ => format!(" ({nth})"),
        };
        format!("{file}.rs {function}: {change}{which}")
    }
}

impl fmt::Display for Mutant {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:4} :{:<4} {}", self.number, self.line, self.key())
    }
}

/// A source file with its changes.
pub(crate) struct Source {
    pub(crate) path: PathBuf,
    text: String,
    edits: Vec<Edit>,
}

/// The protocol's sources.
pub(crate) struct Sources {
    pub(crate) files: Vec<Source>,
    mutants: Vec<Mutant>,
}

/// Text to insert at a place, or to put in the place of other text.
struct Edit {
    range: Range<usize>,
    /// At one place, what closes comes before what opens; the deeper closes first and opens last.
    order: (u8, i32),
    text: String,
}

impl Sources {
    pub(crate) fn read(root: &Path) -> Result<Self, Failure> {
        let mut sources = Self {
            files: Vec::new(),
            mutants: Vec::new(),
        };
        for file in FILES {
            let path = root.join(format!("protocol/src/{file}.rs"));
            let text = std::fs::read_to_string(&path).map_err(Failure::file(&path))?;
            let syntax = syn::parse_file(&text).map_err(|cause| Failure::Syntax {
                path: path.clone(),
                cause,
            })?;
            let mut finder = Finder {
                file,
                text: &text,
                function: String::new(),
                depth: 0,
                forced: 0..0,
                edits: Vec::new(),
                mutants: &mut sources.mutants,
            };
            finder.visit_file(&syntax);
            let edits = finder.edits;
            sources.files.push(Source { path, text, edits });
        }
        Ok(sources)
    }

    pub(crate) fn mutants(&self) -> &[Mutant] {
        &self.mutants
    }
}

impl Source {
    /// The source with all changes built in, each behind its number.
    pub(crate) fn schema(&self) -> String {
        let mut edits: Vec<&Edit> = self.edits.iter().collect();
        edits.sort_by_key(|edit| (edit.range.start, edit.order));
        let mut schema = String::new();
        let mut at = 0;
        for edit in edits {
            schema.push_str(&self.text[at..edit.range.start]);
            schema.push_str(&edit.text);
            at = edit.range.end;
        }
        schema.push_str(&self.text[at..]);
        schema
    }
}

struct Finder<'a> {
    file: &'static str,
    text: &'a str,
    function: String,
    depth: i32,
    /// The condition that was forced last.
    forced: Range<usize>,
    edits: Vec<Edit>,
    mutants: &'a mut Vec<Mutant>,
}

impl Finder<'_> {
    fn mutant(&mut self, at: proc_macro2::Span, change: impl Into<String>) -> usize {
        let number = self.mutants.len() + 1;
        let mut mutant = Mutant {
            number,
            file: self.file,
            line: at.start().line,
            function: self.function.clone(),
            change: change.into(),
            nth: 1,
        };
        while self.mutants.iter().any(|m| m.key() == mutant.key()) {
            mutant.nth += 1;
        }
        self.mutants.push(mutant);
        number
    }

    fn wrap(&mut self, range: &Range<usize>, before: String, after: &str) {
        self.edits.push(Edit {
            range: range.start..range.start,
            order: (1, self.depth),
            text: before,
        });
        self.edits.push(Edit {
            range: range.end..range.end,
            order: (0, -self.depth),
            text: after.to_owned(),
        });
        self.depth += 1;
    }

    fn source_of(&self, spanned: &impl Spanned) -> String {
        let text = &self.text[spanned.span().byte_range()];
        text.split_whitespace().collect::<Vec<_>>().join(" ")
    }

    /// The source of an expression as it stands in the text of a mutant.
    fn words_of(&self, spanned: &impl Spanned) -> String {
        let text = self.source_of(spanned);
        let mut start: String = text.chars().take(TEXT_MAX).collect();
        if start.len() < text.len() {
            start.push('…');
        }
        start
    }

    fn negate(&mut self, expression: &impl Spanned) {
        if self.forced == expression.span().byte_range() {
            // It is always true, and never true, already.
            return;
        }
        let change = format!("`{}` is negated", self.words_of(expression));
        let number = self.mutant(expression.span(), change);
        let range = expression.span().byte_range();
        self.wrap(&range, format!("crate::mutant::flip({number}, "), ")");
    }

    /// A condition that is always true, or never.
    fn force(&mut self, condition: &syn::Expr, text: &str) {
        if has_let(condition) {
            return;
        }
        let always = self.mutant(condition.span(), format!("{text} is always true"));
        let _ = self.mutant(condition.span(), format!("{text} is never true"));
        let range = condition.span().byte_range();
        self.forced = range.clone();
        self.wrap(&range, format!("crate::mutant::force({always}, "), ")");
    }

    fn binary(&mut self, binary: &syn::ExprBinary) {
        let (left, right) = (&*binary.left, &*binary.right);
        let whole = binary.span().byte_range();
        let op = binary.op.span().byte_range();
        let text = self.words_of(binary);
        let (function, change) = match binary.op {
            syn::BinOp::Eq(_) | syn::BinOp::Ne(_) => {
                self.negate(binary);
                return;
            }
            syn::BinOp::Lt(_) => ("lt", "`<` becomes `<=`"),
            syn::BinOp::Le(_) => ("le", "`<=` becomes `<`"),
            syn::BinOp::Gt(_) => ("gt", "`>` becomes `>=`"),
            syn::BinOp::Ge(_) => ("ge", "`>=` becomes `>`"),
            syn::BinOp::And(_) if !has_let(left) && !has_let(right) && !escapes(right) => {
                let number =
                    self.mutant(binary.op.span(), format!("`&&` becomes `||` in `{text}`"));
                self.wrap(&whole, format!("crate::mutant::and({number}, "), ")");
                self.replace(op, ", || ");
                return;
            }
            syn::BinOp::Or(_) if !escapes(right) => {
                let number =
                    self.mutant(binary.op.span(), format!("`||` becomes `&&` in `{text}`"));
                self.wrap(&whole, format!("crate::mutant::or({number}, "), ")");
                self.replace(op, ", || ");
                return;
            }
            _ => return,
        };
        let number = self.mutant(binary.op.span(), format!("{change} in `{text}`"));
        self.wrap(
            &whole,
            format!("crate::mutant::{function}({number}, &("),
            "))",
        );
        self.replace(op, "), &(");
    }

    fn replace(&mut self, range: Range<usize>, text: &str) {
        self.edits.push(Edit {
            range,
            order: (0, i32::MAX),
            text: text.to_owned(),
        });
    }

    fn function(&mut self, signature: &syn::Signature, block: &syn::Block) {
        let name = signature.ident.to_string();
        if signature.constness.is_some() && IN_CONSTANTS.contains(&name.as_str()) {
            return;
        }
        self.function = name;
        let is_bool = matches!(&signature.output, syn::ReturnType::Type(_, of) if self.source_of(of) == "bool");
        // What compares is changed by itself.
        let is_plain = |e: &syn::Expr| {
            !matches!(
                e,
                syn::Expr::Binary(_)
                    | syn::Expr::Unary(_)
                    | syn::Expr::Lit(_)
                    | syn::Expr::Macro(_)
            )
        };
        if is_bool
            && let Some(syn::Stmt::Expr(last, None)) = block.stmts.last()
            && is_plain(last)
        {
            self.force(last, "the result");
        }
        self.visit_block(block);
    }

    fn drop_statement(&mut self, statement: &syn::Stmt) {
        let text = self.words_of(statement);
        let number = self.mutant(statement.span(), format!("`{text}` is left out"));
        let range = statement.span().byte_range();
        self.wrap(&range, format!("if !crate::mutant::on({number}) {{ "), " }");
    }
}

/// Whether an expression binds names, so that it cannot be put into a function's argument.
fn has_let(expression: &syn::Expr) -> bool {
    match expression {
        syn::Expr::Let(_) => true,
        syn::Expr::Binary(binary) => has_let(&binary.left) || has_let(&binary.right),
        _ => false,
    }
}

/// Whether an expression leaves the function from within, so that it cannot be put into a closure.
fn escapes(expression: &syn::Expr) -> bool {
    struct Escape(bool);
    impl<'a> Visit<'a> for Escape {
        fn visit_expr_try(&mut self, _: &'a syn::ExprTry) {
            self.0 = true;
        }
        fn visit_expr_return(&mut self, _: &'a syn::ExprReturn) {
            self.0 = true;
        }
    }
    let mut escape = Escape(false);
    escape.visit_expr(expression);
    escape.0
}

impl<'a> Visit<'a> for Finder<'_> {
    fn visit_item_mod(&mut self, _: &'a syn::ItemMod) {
        // Tests and serialization.
    }

    fn visit_item_impl(&mut self, item: &'a syn::ItemImpl) {
        let of_trait = item.trait_.as_ref();
        let name = of_trait.and_then(|(_, path, _)| path.segments.last());
        if name.is_none_or(|name| !SHOWN.contains(&name.ident.to_string().as_str())) {
            visit::visit_item_impl(self, item);
        }
    }

    fn visit_impl_item_fn(&mut self, function: &'a syn::ImplItemFn) {
        self.function(&function.sig, &function.block);
    }

    fn visit_item_fn(&mut self, function: &'a syn::ItemFn) {
        self.function(&function.sig, &function.block);
    }

    fn visit_macro(&mut self, call: &'a syn::Macro) {
        if call.path.is_ident("matches") {
            self.negate(call);
        }
    }

    fn visit_expr_if(&mut self, expression: &'a syn::ExprIf) {
        let text = format!("`{}`", self.words_of(&expression.cond));
        self.force(&expression.cond, &text);
        visit::visit_expr_if(self, expression);
    }

    fn visit_arm(&mut self, arm: &'a syn::Arm) {
        if let Some((_, guard)) = &arm.guard {
            let text = format!("`{}`", self.words_of(guard));
            self.force(guard, &text);
        }
        visit::visit_arm(self, arm);
    }

    fn visit_expr_binary(&mut self, binary: &'a syn::ExprBinary) {
        self.binary(binary);
        visit::visit_expr_binary(self, binary);
    }

    fn visit_expr_unary(&mut self, unary: &'a syn::ExprUnary) {
        if matches!(unary.op, syn::UnOp::Not(_)) {
            self.negate(unary);
        }
        visit::visit_expr_unary(self, unary);
    }

    fn visit_expr_call(&mut self, call: &'a syn::ExprCall) {
        if self.source_of(&call.func).ends_with("Countdown::armed")
            && let Some(time) = call.args.first()
        {
            let text = self.words_of(time);
            let number = self.mutant(
                time.span(),
                format!("a timer is armed with a quarter of `{text}`"),
            );
            let range = time.span().byte_range();
            self.wrap(&range, format!("crate::mutant::quarter({number}, "), ")");
        }
        visit::visit_expr_call(self, call);
    }

    fn visit_stmt(&mut self, statement: &'a syn::Stmt) {
        let effect = match statement {
            syn::Stmt::Expr(expression, Some(_)) => matches!(
                expression,
                syn::Expr::MethodCall(_)
                    | syn::Expr::Call(_)
                    | syn::Expr::Assign(_)
                    | syn::Expr::Try(_)
            ),
            syn::Stmt::Local(local) => matches!(local.pat, syn::Pat::Wild(_)),
            _ => false,
        };
        if effect {
            self.drop_statement(statement);
        }
        visit::visit_stmt(self, statement);
    }
}
