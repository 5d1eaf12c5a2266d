//! Reads the SVG of a figure, and checks what holds for every figure.

/// An XML element: its name, its attributes and the text right after its opening tag.
#[derive(Debug)]
pub(crate) struct Element {
    pub(crate) name: String,
    attributes: Vec<(String, String)>,
    text: String,
}

impl Element {
    pub(crate) fn attribute(&self, name: &str) -> Option<&str> {
        self.attributes.iter().find(|(key, _)| key == name).map(|(_, value)| &**value)
    }

    pub(crate) fn number(&self, name: &str) -> f64 {
        let value = self.attribute(name).unwrap_or_else(|| panic!("no {name} in {self:?}"));
        value.parse().unwrap_or_else(|_| panic!("{name}=\"{value}\" is no number"))
    }

    pub(crate) fn is(&self, class: &str) -> bool {
        self.attribute("class").is_some_and(|all| all.split(' ').any(|one| one == class))
    }
}

/// Parses the subset of XML that figures use; panics if it is not well-formed.
fn elements(svg: &str) -> Vec<Element> {
    let mut elements = Vec::new();
    let mut open: Vec<String> = Vec::new();
    let mut rest = svg;
    while let Some(start) = rest.find('<') {
        let (before, from) = rest.split_at(start);
        check_text(before);
        assert!(!open.is_empty() || before.trim().is_empty(), "text outside of the root: {before:?}");
        let end = from.find('>').expect("a tag that ends");
        let tag = &from[1..end];
        rest = &from[end + 1..];
        if let Some(name) = tag.strip_prefix('/') {
            assert_eq!(open.pop().as_deref(), Some(name), "tags are balanced");
            continue;
        }
        assert!(!open.is_empty() || elements.is_empty(), "a single root");
        let empty = tag.ends_with('/');
        let (name, attributes) = parts(tag.trim_end_matches('/'));
        let text = rest[..rest.find('<').unwrap_or(0)].to_owned();
        if !empty {
            open.push(name.clone());
        }
        elements.push(Element { name, attributes, text });
    }
    assert!(open.is_empty() && rest.trim().is_empty(), "open at the end: {open:?} {rest:?}");
    elements
}

fn parts(tag: &str) -> (String, Vec<(String, String)>) {
    let (name, mut rest) = tag.split_once(' ').unwrap_or((tag, ""));
    assert!(name.chars().all(char::is_alphanumeric), "<{tag}>");
    let mut attributes: Vec<(String, String)> = Vec::new();
    while !rest.is_empty() {
        let (key, after) = rest.split_once("=\"").unwrap_or_else(|| panic!("<{tag}>"));
        let (value, after) = after.split_once('"').unwrap_or_else(|| panic!("<{tag}>"));
        check_text(value);
        assert!(!attributes.iter().any(|(known, _)| known == key), "{key} twice in <{tag}>");
        attributes.push((key.to_owned(), value.to_owned()));
        rest = after.trim_start();
    }
    (name.to_owned(), attributes)
}

/// Checks that each `&` begins an entity of XML and that XML allows all characters.
fn check_text(text: &str) {
    for after in text.split('&').skip(1) {
        let known = ["amp;", "lt;", "gt;", "quot;", "#39;"];
        assert!(known.iter().any(|entity| after.starts_with(entity)), "&{after:.10}");
    }
    assert!(text.chars().all(|c| c == '\n' || !c.is_control()), "{text:?}");
}

/// The content of the text elements, with entities resolved: what a reader sees.
pub(crate) fn texts(elements: &[Element]) -> Vec<String> {
    let texts = elements.iter().filter(|element| element.name == "text").map(|element| &element.text);
    let resolved = |text: &String| {
        let text = text.replace("&lt;", "<").replace("&gt;", ">").replace("&quot;", "\"");
        text.replace("&#39;", "'").replace("&amp;", "&")
    };
    texts.map(resolved).collect()
}

/// The points that an element marks or passes through.
pub(crate) fn points(element: &Element) -> Vec<(f64, f64)> {
    match &*element.name {
        "circle" => vec![(element.number("cx"), element.number("cy"))],
        "line" => {
            ["1", "2"].map(|i| (element.number(&format!("x{i}")), element.number(&format!("y{i}")))).to_vec()
        }
        "rect" => {
            let (x, y) = (element.number("x"), element.number("y"));
            vec![(x, y), (x + element.number("width"), y + element.number("height"))]
        }
        "text" if element.attribute("x").is_some() => vec![(element.number("x"), element.number("y"))],
        "path" if element.attribute("transform").is_none() => {
            let d = element.attribute("d").expect("a path has points");
            let pairs = d.trim_end_matches('Z').split(['M', 'L']).filter(|pair| !pair.is_empty());
            let number = |text: &str| text.parse::<f64>().unwrap_or_else(|_| panic!("{text} in {d}"));
            pairs
                .map(|pair| pair.split_once(',').map(|(x, y)| (number(x), number(y))).expect("x,y"))
                .collect()
        }
        _ => Vec::new(),
    }
}

/// Checks what holds for every figure, and returns its elements: well-formed, all numbers finite, everything
/// inside the view box.
#[track_caller]
pub(crate) fn check(svg: &str, what: &str) -> Vec<Element> {
    let elements = elements(svg);
    let root = &elements[0];
    assert_eq!((&*root.name, root.attribute("role")), ("svg", Some("img")), "{what}");
    assert_eq!(root.number("width"), 760.0, "{what}");
    assert_eq!((&*elements[1].name, &*elements[2].name), ("title", "desc"), "{what}");
    let view: Vec<f64> = root
        .attribute("viewBox")
        .expect("a view box")
        .split(' ')
        .map(|part| part.parse().expect("a number"))
        .collect();
    for element in &elements {
        for (key, value) in &element.attributes {
            let lower = value.to_lowercase();
            assert!(!lower.contains("nan") && !lower.contains("inf"), "{what}: {key}=\"{value}\"");
        }
        for (x, y) in points(element) {
            assert!((0.0..=view[2]).contains(&x) && (0.0..=view[3]).contains(&y), "{what}: {element:?}");
        }
    }
    for text in texts(&elements) {
        assert!(!text.contains("NaN") && !text.contains("inf"), "{what}: {text}");
    }
    elements
}
