//! Mistakes in texts as a person sees them: the lines they are about, with marks and remarks.

use annotate_snippets::{AnnotationKind, Group, Level, Renderer, Snippet};
use wavestep::language::{Diagnostic, Label};

/// Longer lines are cut around the place they are shown for.
const WIDTH: usize = 100;

/// How a [`Diagnostic`] is rendered.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Style {
    /// Text alone.
    Plain,
    /// Text with ANSI colour codes, for a terminal.
    Coloured,
}

/// The message with the lines of the text it is about. The text is left out if it is empty.
#[must_use]
pub fn render(diagnostic: &Diagnostic, style: Style) -> String {
    let mut group = Group::with_title(Level::ERROR.primary_title(diagnostic.message()));
    let (name, text) = (diagnostic.source().name(), diagnostic.source().text());
    if !text.is_empty() {
        let primary = Label { span: diagnostic.span(), text: diagnostic.label().to_owned() };
        let mark = |label: &Label, kind: AnnotationKind| {
            let remark = (!label.text.is_empty()).then(|| label.text.clone());
            kind.span(label.span.start..label.span.end).label(remark)
        };
        let secondary = diagnostic.secondary().iter();
        let snippet = Snippet::source(text)
            .path(name)
            .annotation(mark(&primary, AnnotationKind::Primary))
            .annotations(secondary.map(|label| mark(label, AnnotationKind::Context)));
        group = group.element(snippet);
    }
    if let Some(remedy) = diagnostic.remedy() {
        group = group.element(Level::HELP.message(remedy));
    }
    let renderer = match style {
        Style::Plain => Renderer::plain(),
        Style::Coloured => Renderer::styled(),
    };
    renderer.term_width(WIDTH).render(&[group])
}
