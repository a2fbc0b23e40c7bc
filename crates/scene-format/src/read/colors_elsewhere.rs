//! Colours and points in the ways of other programs that are one fault with one way: bytes, alpha, texts of numbers.

use super::elsewhere::{Fields, VECTORS, numbers, vector, vector_elsewhere};
use super::value::{before_unit, expected_for, hex_color, is_picture};
use super::{Reader, hinted, is_expression, plain, shortened};
use crate::codes;
use crate::css_colors::{self, named_color};
use crate::desc::{Metal, is_texture};
use crate::diagnostic::{Diagnostic, Edit};
use crate::schema::{EnumDef, FieldDef, StructDef, Type};
use crate::syntax::ron_literal::number_kind;
use crate::syntax::{Syntax, decode};
use crate::tree::{Item, Kind};

/// The numbers of a text, `"0 1.6 6"`, in the brackets of its syntax.
pub(super) fn numbers_in_text(item: Item<'_, '_>, count: usize) -> Option<String> {
    if item.kind() != Kind::Text {
        return None;
    }
    let text = item.text();
    let inner = text.trim().trim_start_matches(['(', '[', '<']).trim_end_matches([')', ']', '>']);
    let found: Vec<&str> = inner.split([' ', ',', ';']).filter(|number| !number.is_empty()).collect();
    let all = found.len() == count && found.iter().all(|number| number_kind(number).is_some());
    let numbers = found.join(", ");
    all.then(|| if item.syntax() == Syntax::Ron { format!("({numbers})") } else { format!("[{numbers}]") })
}

impl Reader<'_> {
    /// What a word for a colour means: a texture or a var of the scene that is called so, before any of CSS.
    pub(super) fn color_by_name(&self, item: Item<'_, '_>) -> Option<String> {
        let word = item.text();
        match item.kind() {
            Kind::Text | Kind::Word if self.knows_texture(&word) => Some(crate::print::text(&word, item.syntax())),
            _ => self.constant_by_name(item),
        }
    }

    /// The same where no texture can stand.
    pub(crate) fn constant_by_name(&self, item: Item<'_, '_>) -> Option<String> {
        let word = item.text();
        match item.kind() {
            Kind::Text | Kind::Word | Kind::Char if self.knows_var(&word) => Some(format!("\"={word}\"")),
            Kind::Char if hex_color(&word).is_some() => Some(format!("\"{word}\"")),
            Kind::Text | Kind::Word | Kind::Char => named_color(&word).map(|hex| format!("\"{hex}\"")),
            _ => None,
        }
    }

    /// What stands for a colour, as one is written here.
    pub(super) fn color(&self, value: Item<'_, '_>) -> Option<String> {
        let lexeme = value.lexeme();
        match value.kind() {
            Kind::Text | Kind::Word if let Some(color) = self.color_by_name(value) => Some(color),
            Kind::Text if hex_color(&value.text()).is_some() => Some(lexeme.to_owned()),
            Kind::Text if is_picture(&value.text()) => {
                let file = Fields(value.syntax()).name("file");
                Some(match value.syntax() {
                    Syntax::Ron => format!("Texture({file}{lexeme})"),
                    syntax => syntax.of_toml(format!("{{ Texture = {{ file = {lexeme} }} }}")).into_owned(),
                })
            }
            Kind::Integer | Kind::Float => {
                value.number().is_some_and(|grey| (0.0..=1.0).contains(&grey)).then(|| lexeme.to_owned())
            }
            Kind::Tuple | Kind::List if value.name().is_none() => {
                let numbers = numbers(value).filter(|numbers| numbers.len() == 3)?;
                numbers.iter().all(|n| (0.0..=1.0).contains(&decode::number(n))).then(|| lexeme.to_owned())
            }
            Kind::Tuple | Kind::Struct if value.name().is_some_and(is_texture) => Some(lexeme.to_owned()),
            _ => None,
        }
    }
}

/// A colour that stands alone, as one is written here: what needs nothing of the scene to be known.
pub(super) fn color_alone(value: Item<'_, '_>) -> Option<String> {
    let share = |number: &&str| (0.0..=1.0).contains(&decode::number(number));
    match value.kind() {
        Kind::Text if is_expression(value) => Some(value.lexeme().to_owned()),
        Kind::Text | Kind::Word | Kind::Char => {
            let text = value.text();
            let hex = hex_color(&text).map(|_| text.trim().to_owned()).or_else(|| named_color(&text));
            hex.or_else(|| css_colors::function(text.trim()).map(|(hex, _)| hex)).map(|hex| format!("\"{hex}\""))
        }
        Kind::Integer | Kind::Float => Some(value.lexeme()).filter(share).map(str::to_owned),
        Kind::Tuple | Kind::List => {
            let channels = numbers(value).filter(|channels| channels.len() == 3)?;
            match value.name().map(str::to_ascii_lowercase) {
                _ if !channels.iter().all(share) => bytes(&channels),
                None => Some(value.lexeme().to_owned()),
                Some(name) => VECTORS.contains(&&*name).then(|| vector(value, &channels)),
            }
        }
        _ => None,
    }
}

/// Channels that can be nothing but bytes, as a colour.
fn bytes(channels: &[&str]) -> Option<String> {
    let whole: Vec<u8> = channels.iter().map(|channel| channel.parse().ok()).collect::<Option<_>>()?;
    let digits: String = whole.iter().map(|byte| format!("{byte:02x}")).collect();
    whole.iter().any(|byte| f64::from(*byte) > LITTLE).then(|| format!("\"#{digits}\""))
}

/// What to write for a metal that stands where a colour does: some metals are names of colours, too, which nobody means
/// who writes them as metals are written here.
pub(super) fn metal(name: &str, item: Item<'_, '_>) -> Option<String> {
    let metal = Metal::DEF.variant(name)?.name;
    let (conductor, color) = match item.syntax() {
        Syntax::Ron => (format!("Conductor(metal: {metal})"), "(r, g, b)"),
        syntax => (syntax.of_toml(format!("{{ Conductor = {{ metal = \"{metal}\" }} }}")).into_owned(), "[r, g, b]"),
    };
    Some(format!("the metal is a material: {conductor}; a colour like it is written {color}"))
}

/// Channels of bytes, of which none is more, would be nearly black.
const LITTLE: f64 = 20.0;

/// The names of a surface's colour elsewhere.
const COLORS: [&str; 11] =
    ["color", "colour", "albedo", "rgb", "diffuse", "base_color", "texture", "map", "diffuse_color", "pigment", "hex"];

impl Reader<'_> {
    /// The colour of `{ color: (1, 0, 0) }`, which is nothing but that.
    fn only_color(&self, item: Item<'_, '_>) -> Option<String> {
        let mut fields = item.fields();
        let (key, value) = fields.next().filter(|_| fields.next().is_none())?;
        // What has a header of its own in TOML is not in one piece.
        let whole = item.lexeme().starts_with(['{', '(']) && COLORS.contains(&&*key.text());
        self.color(value).filter(|_| whole)
    }

    /// `{ color: (1, 0, 0) }` where a material stands: what to do, and the edit.
    pub(super) fn color_as_material(
        &self,
        item: Item<'_, '_>,
        def: &'static EnumDef,
    ) -> Option<(String, Option<Edit>)> {
        if def.noun != "material" {
            return None;
        }
        if let Some(color) = self.only_color(item) {
            let replacement = diffuse(&color, item.syntax());
            return Some((format!("write {}", hinted(&replacement)), Some(Edit { span: item.span(), replacement })));
        }
        let mut fields = item.fields();
        let (key, value) = fields.next().filter(|_| fields.next().is_none())?;
        let color = self.color(value).filter(|_| COLORS.contains(&&*key.text()))?;
        let header = Some(item.lexeme()).filter(|header| header.starts_with('['))?;
        let path = header.trim_matches(['[', ']']);
        Some((format!("below [{path}.Diffuse] write albedo = {color}"), None))
    }

    /// The field of a material for the colour of an object: what is written is no list of colours of points.
    pub(super) fn color_of_object(&self, name: &str, value: Item<'_, '_>, def: &'static StructDef) -> Option<String> {
        if def.field("material").is_none() || def.field(name).is_some() || !COLORS.contains(&name) {
            return None;
        }
        let material = diffuse(&self.color(value)?, value.syntax());
        Some(format!("{}{material}", Fields(value.syntax()).name("material")))
    }
}

/// A material of this colour.
pub(super) fn diffuse(color: &str, syntax: Syntax) -> String {
    match syntax {
        Syntax::Ron => format!("Diffuse(albedo: {color})"),
        syntax => syntax.of_toml(format!("{{ Diffuse = {{ albedo = {color} }} }}")).into_owned(),
    }
}

/// Whether the scene has a material of this name. Values are read before materials are.
fn is_name_of_material(item: Item<'_, '_>, name: &str) -> bool {
    is_named_in("materials", item, name)
}

/// Whether a map of the scene itself has this name.
pub(super) fn is_named_in(map: &str, item: Item<'_, '_>, name: &str) -> bool {
    let scene = item.other(0);
    let map = scene.and_then(|scene| scene.fields().find(|(key, _)| key.text() == map));
    map.is_some_and(|(_, map)| map.fields().any(|(key, _)| key.text() == name))
}

impl Reader<'_> {
    /// Channels from 0 to 255, `(208, 58, 43)`, which are reported once.
    pub(super) fn bytes_as_color(&mut self, item: Item<'_, '_>, at: &'static FieldDef) -> bool {
        let name = item.name().map(str::to_ascii_lowercase);
        let is_color = name.as_deref().is_none_or(|name| VECTORS.contains(&name));
        if !at.rule.color || !is_color || !matches!(item.kind(), Kind::List | Kind::Tuple) {
            return false;
        }
        let Some(channels) = numbers(item).filter(|numbers| numbers.len() == 3) else { return false };
        let values: Vec<f64> = channels.iter().map(|number| decode::number(number)).collect();
        let bytes = values.iter().all(|value| value.fract() == 0.0 && (0.0..=255.0).contains(value));
        let most = values.iter().copied().fold(0.0, f64::max);
        let is_share = at.rule.range.high == 1.0;
        // Of light there may be more than 1, in a vector as much as there is.
        if !bytes || is_share && most <= 2.0 || !is_share && (name.is_none() || most <= LITTLE) {
            return false;
        }
        let hex: String = values.iter().map(|value| format!("{:02x}", *value as u8)).collect();
        if !is_share {
            let message = format!("{} cannot be {}", plain(at.noun), super::describe(item));
            let light = super::elsewhere::vector(item, &channels);
            self.report(
                Diagnostic::error(codes::WRONG_TYPE, item.head(), message)
                    .expected(expected_for(at, item))
                    .hint(format!("write \"#{hex}\" for a colour of bytes, or {light} for so much light")),
            );
            return true;
        }
        let percents = most <= 100.0 && values.iter().all(|value| value % 5.0 == 0.0);
        let is_certain = most > LITTLE && !percents;
        if is_certain && name.is_some() {
            self.wrong_kind::<()>(item, at.noun, &expected_for(at, item), Some(format!("\"#{hex}\"")));
            return true;
        }
        let message = format!("the channels of {} must be at most 1", plain(at.noun));
        let mut fault = Diagnostic::error(codes::OUT_OF_RANGE, item.span(), message)
            .expected(expected_for(at, item))
            .hint(format!("channels go from 0 to 1; of values up to 255 write \"#{hex}\""));
        if percents {
            let shares: Vec<String> = values.iter().map(|value| format!("{}", value / 100.0)).collect();
            let shares: Vec<&str> = shares.iter().map(|share| &**share).collect();
            fault.hint = format!("{}, of percents {}", fault.hint, super::elsewhere::vector(item, &shares));
        }
        fault.edit = is_certain.then(|| Edit { span: item.span(), replacement: format!("\"#{hex}\"") });
        self.report(fault);
        true
    }

    /// The name of a picture where the output stands.
    pub(super) fn output_as_text<T>(&mut self, item: Item<'_, '_>) -> Option<T> {
        let message = format!("the output cannot be {}", super::describe(item));
        let fault = Diagnostic::error(codes::WRONG_TYPE, item.head(), message)
            .expected("Output(alpha: true), and its other fields");
        let hint = "the picture's name stands on the command line: tracer render scene.ron -o picture.png";
        self.report(fault.hint(hint));
        None
    }

    /// Channels with names, `(r: 1, g: 0, b: 0)`, or the name of a colour, where a texture stands: reported here.
    pub(super) fn color_as_texture(&mut self, item: Item<'_, '_>, def: &'static EnumDef) -> bool {
        if !matches!(def.noun, "texture" | "background") {
            return false;
        }
        let mended = match item.kind() {
            Kind::Struct | Kind::Map => super::elsewhere::channels(item).or_else(|| self.only_color(item)),
            Kind::Word if def.noun == "texture" => self.color_by_name(item),
            Kind::Word => self.constant_by_name(item),
            _ => None,
        };
        let metal = Some(item).filter(|item| item.kind() == Kind::Word).and_then(|item| metal(item.lexeme(), item));
        let message = format!("a colour cannot be {}", super::describe(item));
        let mut fault = Diagnostic::error(codes::WRONG_TYPE, item.head(), message)
            .expected("a colour: (r, g, b), one number for grey, or \"#rrggbb\"");
        match (metal, mended) {
            (Some(metal), _) => fault.hint = metal,
            (None, Some(mended)) => {
                fault.hint = format!("write {mended}");
                fault.edit = Some(Edit { span: item.span(), replacement: mended });
            }
            (None, None) => return false,
        }
        self.report(fault);
        true
    }
}

/// A colour whose fourth number is an alpha of 1, without it.
pub(super) fn without_alpha(item: Item<'_, '_>, at: &FieldDef, right: usize) -> Option<String> {
    let numbers = numbers(item).filter(|numbers| at.rule.color && right == 3 && numbers.len() == 4)?;
    let inner = numbers[..3].join(", ");
    let opaque = decode::number(numbers[3]) == 1.0;
    opaque.then(|| if item.syntax() == Syntax::Ron { format!("({inner})") } else { format!("[{inner}]") })
}

/// What is written here for a value in the brackets of another kind.
pub(super) fn in_other_brackets(item: Item<'_, '_>, at: &FieldDef) -> Option<String> {
    let per_axis = matches!(at.kind.resolved(), Type::OneOf([Type::Number, Type::Vector]));
    in_braces(item, at).or_else(|| vector_elsewhere(item, at, 3).filter(|_| per_axis))
}

/// `{ "h": 2 }` for `(h: 2)`, names with their values in the brackets of fields.
fn in_braces(item: Item<'_, '_>, at: &FieldDef) -> Option<String> {
    if !matches!(at.kind, Type::Map(_))
        || item.kind() != Kind::Struct
        || item.name().is_some()
        || item.syntax() != Syntax::Ron
    {
        return None;
    }
    const MOST: usize = 20;
    let entries: Vec<String> =
        item.fields().take(MOST + 1).map(|(key, value)| format!("\"{}\": {}", key.text(), value.lexeme())).collect();
    (entries.len() <= MOST).then(|| format!("{{ {} }}", entries.join(", ")))
}

impl Reader<'_> {
    /// `0xd03a2b`: a colour as other languages write it.
    pub(super) fn hexadecimal(&mut self, item: Item<'_, '_>, at: &'static FieldDef) -> Option<[f64; 3]> {
        let mended = format!("\"#{}\"", &item.lexeme()[2..]);
        let mut fault =
            Diagnostic::error(codes::BAD_COLOR, item.span(), format!("{} cannot be one whole number", plain(at.noun)))
                .expected(expected_for(at, item))
                .hint(format!("write {mended}"));
        fault.edit = Some(Edit { span: item.span(), replacement: mended });
        self.report(fault);
        None
    }

    /// Whether a text that is no colour here is one elsewhere, or a number, a var or a picture: no name of a texture.
    pub(super) fn is_another_color(&self, text: &str) -> bool {
        let word = text.trim();
        let digits = word.trim_start_matches('#');
        let hex = matches!(digits.len(), 3 | 6) && digits.bytes().all(|b| b.is_ascii_hexdigit());
        let known = self.knows_var(word) || named_color(text).is_some() || css_colors::function(word).is_some();
        known || hex || word.is_empty() || decode::number(text).is_finite() || is_picture(text)
    }

    // Long: one arm for each way that colours are written.
    pub(crate) fn text_color(&mut self, item: Item<'_, '_>, at: &'static FieldDef) -> Option<[f64; 3]> {
        let text = item.text();
        if let Some(color) = hex_color(&text) {
            return Some(color);
        }
        let mut fault = Diagnostic::error(
            codes::BAD_COLOR,
            item.span(),
            format!("{} cannot be read from the text {}", plain(at.noun), shortened(item.lexeme())),
        )
        .expected(expected_for(at, item));
        let is_value = matches!(at.kind, Type::Value);
        if self.knows_var(text.trim()) || is_value && self.is_reckoned(text.trim()) {
            let mended = format!("\"={}\"", text.trim());
            fault.hint = format!("write {mended}");
            fault.edit = Some(Edit { span: item.span(), replacement: mended });
            self.report(fault);
            return None;
        }
        if let Some(mended) = numbers_in_text(item, 3) {
            fault.hint = format!("write {mended}");
            fault.edit = Some(Edit { span: item.span(), replacement: mended });
            self.report(fault);
            return None;
        }
        if let Some((hex, _)) = css_colors::function(text.trim()) {
            fault.hint = format!("write \"{hex}\"");
            fault.edit = Some(Edit { span: item.span(), replacement: format!("\"{hex}\"") });
            self.report(fault);
            return None;
        }
        if is_value && is_name_of_material(item, &text) {
            let name = item.lexeme();
            fault.hint = format!(
                "it is a material, whose name stands where it is due; one of several is taken by Pick(from: [{name}, \
                 ..], index: 0)"
            );
            self.report(fault);
            return None;
        }
        if let Some(metal) = metal(&text, item) {
            fault.hint = metal;
            self.report(fault);
            return None;
        }
        if let Some(hex) = named_color(&text) {
            fault.hint = format!("colours have no names here: write \"{hex}\"");
            fault.edit = Some(Edit { span: item.span(), replacement: format!("\"{hex}\"") });
            self.report(fault);
            return None;
        }
        let digits = text.trim().trim_start_matches('#');
        let hex = !digits.is_empty() && digits.bytes().all(|b| b.is_ascii_hexdigit());
        let mended = match digits.len() {
            6 if hex => Some(digits.to_owned()),
            3 if hex => Some(digits.chars().flat_map(|c| [c, c]).collect()),
            _ => None,
        };
        if let Some(digits) = mended {
            fault.hint = format!("did you mean \"#{digits}\"?");
            fault.edit = Some(Edit { span: item.span(), replacement: format!("\"#{digits}\"") });
        } else if decode::number(&text).is_finite() {
            fault.hint = "write the number without quotes".to_owned();
            fault.edit = Some(Edit { span: item.span(), replacement: text.into_owned() });
        } else if let Some(mended) = super::elsewhere::of_kelvins(&text, at) {
            fault.hint = format!("the colour of that temperature is {mended}");
            fault.edit = Some(Edit { span: item.span(), replacement: mended });
        } else if let Some(number) = before_unit(&text) {
            fault.hint = format!("numbers carry no unit: write {number}");
            fault.edit = Some(Edit { span: item.span(), replacement: number.to_owned() });
        } else if let Some(sign) = digits.chars().find(|c| !c.is_ascii_hexdigit()).filter(|_| text.starts_with('#')) {
            fault.hint = format!("`{sign}` is no hexadecimal digit, which are 0 to 9 and a to f");
        } else if hex && text.starts_with('#') {
            fault.hint = format!("this has {} digits; it needs two for each of red, green and blue", digits.len());
        } else if is_picture(&text) && expected_for(at, item).contains("Texture") {
            let replacement = match item.syntax() {
                Syntax::Ron => format!("Texture(file: {})", item.lexeme()),
                syntax => syntax.of_toml(format!("{{ Texture = {{ file = {} }} }}", item.lexeme())).into_owned(),
            };
            fault.hint = format!("a picture is written {}", shortened(&replacement));
            fault.edit = Some(Edit { span: item.span(), replacement });
        } else if is_picture(&text) && at.name == "background" {
            let replacement = match item.syntax() {
                Syntax::Ron => format!("Environment(file: {})", item.lexeme()),
                syntax => syntax.of_toml(format!("{{ Environment = {{ file = {} }} }}", item.lexeme())).into_owned(),
            };
            fault.hint = format!("a picture of all directions is written {}", shortened(&replacement));
            fault.edit = Some(Edit { span: item.span(), replacement });
        } else if is_value {
            fault.hint = "a text is no value: an expression begins with `=`, a colour with `#`".to_owned();
        } else {
            fault.hint = match item.syntax() {
                Syntax::Ron => "colours have no names here; red is (1, 0, 0) or \"#ff0000\"".to_owned(),
                _ => "colours have no names here; red is [1, 0, 0] or \"#ff0000\"".to_owned(),
            };
        }
        self.report(fault);
        None
    }
}
