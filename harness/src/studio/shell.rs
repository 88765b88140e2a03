//! The server of the views.
//!
//! Pages, style and scripts are in the program, and load nothing from elsewhere. Text of logs reaches
//! a page as JSON and is put into it as text, never as markup; the browser runs no other script
//! (see the policy in the head of each answer). Only clients that name this machine are answered, so that a page of a
//! stranger whose name is made to lead here reads nothing.

use std::borrow::Cow;
use std::fmt::Write as _;
use std::net::SocketAddr;
use std::path::Path;

use super::Studio;
use crate::http::{self, Answer, Request};

/// Headers of each answer: the page may run and load what this server has, and nothing else.
const HEADERS: &str = "Content-Security-Policy: default-src 'none'; script-src 'self'; style-src 'self'; \
    img-src 'self'; connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'\r\n\
    X-Content-Type-Options: nosniff\r\nReferrer-Policy: no-referrer\r\nCross-Origin-Resource-Policy: same-origin\r\n\
    Cross-Origin-Opener-Policy: same-origin\r\nCache-Control: no-store\r\n";

/// The most octets that a page may send with one question.
const QUESTION_MAX: usize = 1 << 20;

/// The most octets of logs that a page may send.
const LOGS_MAX: usize = 1 << 26;

const TEXT: &str = "text/plain; charset=utf-8";
const HTML: &str = "text/html; charset=utf-8";

/// Frame of all pages around their content.
const FRAME: &str = include_str!("shell/page.html");

/// Text in front of the content of each view.
const SCRIPTED: &str = "<noscript><p class=\"trouble\">This page needs its scripts, which come from this server \
    alone.</p></noscript>\n<div id=\"troubles\" role=\"alert\"></div>\n";

/// A file of a page: its name, and what is in it. The end of the name says the type.
pub(super) type Asset = (&'static str, &'static str);

/// The files that pages share.
const SHARED: [Asset; 12] = [
    ("studio.css", include_str!("shell/studio.css")),
    ("icon.svg", include_str!("shell/icon.svg")),
    ("dom.js", include_str!("shell/dom.js")),
    ("run.css", include_str!("run/run.css")),
    ("map.js", include_str!("run/map.js")),
    ("messages.js", include_str!("run/messages.js")),
    ("panels.js", include_str!("run/panels.js")),
    ("walk.css", include_str!("walk/walk.css")),
    ("chart.js", include_str!("walk/chart.js")),
    ("scene.js", include_str!("walk/scene.js")),
    ("model.js", include_str!("walk/model.js")),
    ("worker.js", include_str!("walk/worker.js")),
];

/// A page of a view.
pub(super) struct Page {
    /// It is at `/NAME/`.
    pub(super) name: &'static str,
    /// How it is called on pages.
    pub(super) title: &'static str,
    /// Its purpose, in a sentence.
    pub(super) about: &'static str,
    /// Where its first link leads.
    pub(super) skip: Skip,
    /// Its content below the header.
    pub(super) content: &'static str,
    /// The style that it shares with another view.
    pub(super) shared_style: Option<&'static str>,
    /// Its scripts and styles, `NAME.js` and `NAME.css` among them.
    pub(super) files: &'static [Asset],
}

/// A view: a page, and what it asks the server.
pub(super) trait View: Send + Sync {
    /// Its page.
    fn page(&self) -> &'static Page;
    /// The command that gives it something to show, where this studio was given nothing.
    fn wants(&self) -> Option<&'static str> {
        None
    }
    /// Questions without a body whose answers are the same everywhere; with the model beside it, the page needs no other server.
    fn fixed(&self) -> &'static [&'static str] {
        &[]
    }
    /// The question that commands robots or writes a file: only a page of this server asks it, for the user of this process.
    fn commands(&self) -> Option<&'static str> {
        None
    }
    /// The answer, in JSON, to `/NAME/api/WHAT?QUERY`, with the body of a POST.
    fn ask(&self, what: &str, query: &str, body: &[u8]) -> Result<String, Refusal>;
}

/// A link past the header, for users of the keyboard.
pub(super) struct Skip {
    /// The element that gets the focus.
    pub(super) to: &'static str,
    /// The text of the link.
    pub(super) words: &'static str,
}

pub(super) use crossguard_model_check::walk::Refusal;

/// An answer.
pub(super) fn json(value: &impl serde::Serialize) -> Result<String, Refusal> {
    serde_json::to_string(value).map_err(|cause| Refusal::Wrong(cause.to_string()))
}

/// The value of a name in a query.
pub(super) fn value<'a>(query: &'a str, name: &str) -> Option<&'a str> {
    let mut pairs = query.split('&').filter_map(|pair| pair.split_once('='));
    pairs.find(|(key, _)| *key == name).map(|(_, value)| value)
}

/// Serves the pages at `address` until the process ends. The address that they are served at.
///
/// # Errors
/// When nothing can be served there.
pub fn serve(address: SocketAddr, studio: Studio) -> std::io::Result<SocketAddr> {
    let views = studio.views();
    let body_max = |path: &str| match path {
        "/after/api/logs" => LOGS_MAX,
        _ => QUESTION_MAX,
    };
    http::serve(address, "studio", body_max, move |request| {
        respond(request, &views)
    })
}

fn respond(request: &Request, views: &[Box<dyn View>]) -> Answer {
    let path = request.path.trim_start_matches('/');
    if path.is_empty() {
        return answer("200 OK", HTML, home(views.iter().map(|it| &**it)));
    }
    let Some((folder, file)) = path.split_once('/') else {
        let view = views.iter().find(|view| view.page().name == path);
        return view.map_or_else(nothing, |view| moved(view.page().name));
    };
    if folder == "shell" {
        return find(&SHARED, file);
    }
    let Some(view) = views.iter().find(|view| view.page().name == folder) else {
        return nothing();
    };
    if file.is_empty() || file == "index.html" {
        return answer("200 OK", HTML, page(views.iter().map(|it| &**it), &**view));
    }
    let Some(what) = file.strip_prefix("api/") else {
        return find(view.page().files, file);
    };
    let foreign = || request.foreign().filter(|_| view.commands() == Some(what));
    if let Some(cause) = foreign() {
        return answer("403 Forbidden", TEXT, cause);
    }
    match view.ask(what, request.query, request.body) {
        Ok(json) => answer("200 OK", "application/json", json),
        Err(Refusal::Unknown) => nothing(),
        Err(Refusal::Wrong(cause)) => answer("400 Bad Request", TEXT, format!("{cause}\n")),
    }
}

/// To the folder of a view: its files are beside its page.
fn moved(view: &str) -> Answer {
    let answer = answer("308 Permanent Redirect", TEXT, "the page is a folder\n");
    Answer {
        headers: format!("{}Location: /{view}/\r\n", answer.headers).into(),
        ..answer
    }
}

fn nothing() -> Answer {
    answer("404 Not Found", TEXT, "the page is at /\n")
}

fn find(files: &[Asset], name: &str) -> Answer {
    let Some((_, text)) = files.iter().find(|(file, _)| *file == name) else {
        return nothing();
    };
    let kind = match name.rsplit('.').next() {
        Some("css") => "text/css; charset=utf-8",
        Some("svg") => "image/svg+xml",
        _ => "text/javascript; charset=utf-8",
    };
    answer("200 OK", kind, *text)
}

/// The page of a view.
fn page<'a>(views: impl Iterator<Item = &'a dyn View>, view: &dyn View) -> String {
    let Page {
        name,
        title,
        skip: Skip { to, words },
        content,
        shared_style,
        ..
    } = view.page();
    let shared = shared_style.map(|style| format!("../shell/{style}"));
    let mut head = String::new();
    for style in shared.into_iter().chain([format!("{name}.css")]) {
        let _ = writeln!(head, "<link rel=\"stylesheet\" href=\"{style}\">");
    }
    let _ = write!(head, "<script type=\"module\" src=\"{name}.js\"></script>");
    FRAME
        .replace("<!-- title -->", &format!("{title} · Crossguard studio"))
        .replace("<!-- links -->", &head)
        .replace(
            "<!-- skip -->",
            &format!("<a class=\"skip\" href=\"#{to}\">{words}</a>"),
        )
        .replace("<!-- views -->", &links(views, Some(view)))
        .replace("<!-- content -->", &[SCRIPTED, content.trim_end()].concat())
}

/// Writes the pages that need no server but the model, into a folder for any file server; the model goes to `shell/model.wasm`.
///
/// # Errors
/// When a file cannot be written.
pub fn publish(folder: &Path, studio: Studio) -> std::io::Result<()> {
    let views = studio.views();
    let views = views.iter().map(|it| &**it);
    let views = views.filter(|view| !view.fixed().is_empty());
    let alone = |page: String| {
        let policy = format!(
            "<head>\n<meta http-equiv=\"Content-Security-Policy\" content=\"{PUBLISHED}\">"
        );
        page.replace("<html ", "<html data-model=\"../shell/worker.js\" ")
            .replace("<head>", &policy)
    };
    let write = |name: String, text: &str| {
        let path = folder.join(name);
        path.parent().map_or(Ok(()), std::fs::create_dir_all)?;
        std::fs::write(path, text)
    };
    write("index.html".into(), &alone(home(views.clone())))?;
    for (file, text) in SHARED {
        write(format!("shell/{file}"), text)?;
    }
    for view in views.clone() {
        let name = view.page().name;
        write(
            format!("{name}/index.html"),
            &alone(page(views.clone(), view)),
        )?;
        for (file, text) in view.page().files {
            write(format!("{name}/{file}"), text)?;
        }
        for what in view.fixed() {
            let answer = view.ask(what, "", &[]);
            let answer =
                answer.map_err(|cause| std::io::Error::other(format!("{what}: {cause:?}")))?;
            write(format!("{name}/api/{what}"), &answer)?;
        }
    }
    Ok(())
}

/// Policy of a published page: it may run and load what is beside it.
const PUBLISHED: &str = "default-src 'none'; script-src 'self'; worker-src 'self'; style-src 'self'; img-src 'self'; \
    connect-src 'self'; base-uri 'none'; form-action 'none'";

/// The page of a view as one file, with what it shows in it as JSON. It loads nothing, and runs its own scripts alone.
pub(super) fn saved(view: &dyn View, shown: &str) -> String {
    let page = view.page();
    let (name, files) = (page.name, SHARED.iter().chain(page.files));
    let (mut styles, mut imports) = (String::new(), serde_json::Map::new());
    let own = format!("{name}.css");
    for (name, text) in files {
        if name.rsplit('.').next() == Some("js") {
            let script = text.replace("\"../shell/", "\"").replace("\"./", "\"");
            imports.insert((*name).to_owned(), data_url(&script).into());
        } else if *name == "studio.css" || Some(*name) == page.shared_style || *name == own {
            styles.push_str(text);
        }
    }
    // Whatever texts say, they do not end the element that they are in.
    let shown = shown.replace('<', "\\u003c");
    let imports = serde_json::Value::from(imports);
    FRAME
        .replace("<!-- title -->", "Crossguard run")
        .replace("<link rel=\"icon\" href=\"../shell/icon.svg\">\n", "")
        .replace(
            "<link rel=\"stylesheet\" href=\"../shell/studio.css\">",
            &format!("<meta http-equiv=\"Content-Security-Policy\" content=\"{SAVED}\">\n<style>{styles}</style>"),
        )
        .replace(
            "<!-- links -->",
            &format!("<script type=\"importmap\">{{\"imports\":{imports}}}</script>"),
        )
        .replace("<!-- skip -->\n", "")
        .replace("  <!-- views -->\n", "")
        .replace("Crossguard studio</h1>", "Crossguard run</h1>")
        .replace(
            "<!-- content -->",
            &format!(
                "<div id=\"troubles\" role=\"alert\"></div>\n{}\n<script type=\"application/json\" id=\"saved\">{shown}</script>\n\
                 <script type=\"module\">import \"{name}.js\";</script>",
                page.content.trim_end()
            ),
        )
}

/// Policy of a saved page: it may run and load what is in it.
const SAVED: &str = "default-src 'none'; script-src 'unsafe-inline' data:; style-src 'unsafe-inline'; base-uri 'none'; \
    form-action 'none'";

/// A script as an address that has it in itself.
fn data_url(script: &str) -> String {
    let mut url = String::from("data:text/javascript;charset=utf-8,");
    for octet in script.bytes() {
        if octet.is_ascii_alphanumeric() || b"-_.~()=;,:/+*!".contains(&octet) {
            url.push(octet.into());
        } else {
            let _ = write!(url, "%{octet:02X}");
        }
    }
    url
}

/// The links to the views, one of which may be the page that they stand on.
fn links<'a>(views: impl Iterator<Item = &'a dyn View>, here: Option<&dyn View>) -> String {
    let mut links = String::from("<nav aria-label=\"Views\">");
    for view in views {
        let is_here = here.is_some_and(|here| here.page().name == view.page().name);
        let current = if is_here {
            " aria-current=\"page\""
        } else {
            ""
        };
        let _ = write!(
            links,
            "<a href=\"../{}/\"{current}>{}</a>",
            view.page().name,
            view.page().title
        );
    }
    links + "</nav>"
}

/// The first page: what can be looked at.
fn home<'a>(views: impl Iterator<Item = &'a dyn View> + Clone) -> String {
    let mut cards = String::new();
    for view in views.clone() {
        let _ = write!(
            cards,
            "<li><h2><a href=\"../{}/\">{}</a></h2><p>{}</p>",
            view.page().name,
            view.page().title,
            view.page().about
        );
        if let Some(command) = view.wants() {
            let _ = write!(
                cards,
                "<p class=\"faint\">Nothing to show yet: <code>{command}</code></p>"
            );
        }
        cards.push_str("</li>\n");
    }
    FRAME
        .replace("<!-- title -->", "Crossguard studio")
        .replace("<!-- links -->\n", "")
        .replace("<!-- skip -->\n", "")
        .replace("<!-- views -->", &links(views, None))
        .replace(
            "<!-- content -->",
            &format!("<ul class=\"views\">\n{cards}</ul>"),
        )
        // It is above the folders of the views.
        .replace("=\"../", "=\"")
}

fn answer(
    status: &'static str,
    content_type: &'static str,
    body: impl Into<Cow<'static, str>>,
) -> Answer {
    Answer {
        status,
        content_type,
        headers: HEADERS.into(),
        body: body.into(),
    }
}
