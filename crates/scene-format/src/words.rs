//! The macros that make the language's types: from one declaration come the Rust type, its schema, its reader and its
//! writer.
//!
//! A field is `name: Type = default => rule;` with its doc comment; without a default it must be written, without a
//! rule any value of the type will do.

use crate::form::Form;
use crate::read::Reader;
use crate::schema::{FieldDef, Type};
use crate::tree::Item;

/// A type of the language.
pub(crate) trait Words: Sized {
    /// How the schema describes it.
    const TYPE: Type;

    /// Reads it; `None` when something was wrong, which has been reported then.
    fn read(reader: &mut Reader<'_>, item: Item<'_, '_>, at: &'static FieldDef) -> Option<Self>;

    /// Writes it; `all` makes defaults visible.
    fn form(&self, all: bool) -> Form;
}

/// What is told of a kind beside its words.
pub(crate) trait Told {
    /// Names of other programs for it, in small letters.
    const ALSO: &'static [&'static str];
    /// An example of it.
    const EXAMPLE: &'static str;
}

/// `FieldDef`s from field declarations.
macro_rules! field_defs {
    ($noun:literal; $( $(#[doc = $doc:literal])+ $field:ident : $ty:ty $(= $default:expr)? $(=> $rule:expr)? ; )*) => {
        &[$(
            $crate::schema::FieldDef {
                name: stringify!($field),
                noun: concat!("the ", stringify!($field), " of ", $noun),
                doc: &[$($doc),+],
                kind: <$ty as $crate::words::Words>::TYPE.of_field(&$crate::words::rule!($($rule)?)),
                rule: $crate::words::rule!($($rule)?),
                default: $crate::words::default_form!($ty $(, $default)?),
            },
        )*]
    };
}

macro_rules! rule {
    () => {
        $crate::schema::Rule::ANY
    };
    ($rule:expr) => {
        $rule
    };
}

macro_rules! default_form {
    ($ty:ty) => {
        None
    };
    ($ty:ty, $default:expr) => {
        Some(|| $crate::words::Words::form(&<$ty>::from($default), true))
    };
}

/// The default of a field as a function, if it has one.
macro_rules! default_value {
    ($ty:ty) => {
        None
    };
    ($ty:ty, $default:expr) => {
        Some(|| <$ty>::from($default))
    };
}

/// Whether a field has its default and need not be written.
macro_rules! is_default {
    ($value:expr, $ty:ty) => {
        false
    };
    ($value:expr, $ty:ty, $default:expr) => {{
        let default = <$ty>::from($default);
        *$value == default
    }};
}

/// A struct of named fields.
macro_rules! scene_struct {
    (
        $(#[doc = $doc:literal])+
        $vis:vis struct $Name:ident as $word:literal, $noun:literal $(, exactly one of [$($one:ident),+])? {
            $( $(#[doc = $fdoc:literal])+ $field:ident : $ty:ty $(= $default:expr)? $(=> $rule:expr)? ; )*
        }
    ) => {
        $(#[doc = $doc])+
        #[derive(Clone, Debug, PartialEq)]
        $vis struct $Name {
            $( $(#[doc = $fdoc])+ pub $field: $ty, )*
        }

        impl $Name {
            pub(crate) const DEF: $crate::schema::StructDef = $crate::schema::StructDef {
                name: $word,
                noun: $noun,
                doc: &[$($doc),+],
                fields: $crate::words::field_defs!(
                    $noun; $( $(#[doc = $fdoc])+ $field : $ty $(= $default)? $(=> $rule)? ; )*
                ),
                bare: None,
                exactly_one: &[$($(stringify!($one)),+)?],
            };
        }

        impl $crate::words::Words for $Name {
            const TYPE: $crate::schema::Type = $crate::schema::Type::Struct(&$Name::DEF);

            fn read(
                reader: &mut $crate::read::Reader<'_>,
                item: $crate::tree::Item<'_, '_>,
                _at: &'static $crate::schema::FieldDef,
            ) -> Option<Self> {
                let mut fields = reader.fields(item, &Self::DEF)?;
                $(
                    let default: Option<fn() -> $ty> = $crate::words::default_value!($ty $(, $default)?);
                    let $field: Option<$ty> = reader.field(&mut fields, default);
                )*
                Some(Self { $($field: $field?,)* })
            }

            fn form(&self, all: bool) -> $crate::form::Form {
                let mut fields = Vec::new();
                $(
                    if all || !$crate::words::is_default!(&self.$field, $ty $(, $default)?) {
                        let value = $crate::words::Words::form(&self.$field, all);
                        $crate::form::Entry::push(&mut fields, stringify!($field), value);
                    }
                )*
                $crate::form::Form::Struct { name: $word, fields }
            }
        }
    };
}

/// A choice between kinds: `Name;`, `Name(Type) => rule;` or `Name as "a noun" { fields };`.
macro_rules! scene_enum {
    (
        $(#[doc = $doc:literal])+
        $vis:vis enum $Name:ident, $noun:literal {
            $(
                $(#[doc = $vdoc:literal])+
                $Variant:ident $(as $vnoun:literal $(bare $bare:ident)?)? $(($inner:ty))? $({
                    $( $(#[doc = $fdoc:literal])+ $field:ident : $ty:ty $(= $default:expr)? $(=> $rule:expr)? ; )*
                })? $(=> $vrule:expr)? ;
            )+
        }
    ) => {
        $(#[doc = $doc])+
        #[derive(Clone, Debug, PartialEq)]
        $vis enum $Name {
            $( $(#[doc = $vdoc])+ $Variant $(($inner))? $({ $( $(#[doc = $fdoc])+ $field: $ty, )* })?, )+
        }

        impl $Name {
            pub(crate) const DEF: $crate::schema::EnumDef = $crate::schema::EnumDef {
                name: stringify!($Name),
                noun: $noun,
                doc: &[$($doc),+],
                variants: &[$(
                    $crate::schema::VariantDef {
                        name: stringify!($Variant),
                        doc: &[$($vdoc),+],
                        content: $crate::words::content!(
                            $Variant [$($vnoun $($bare)?)?] [$($vdoc),+] [$($vrule)?] $(($inner))? $({
                                $( $(#[doc = $fdoc])+ $field : $ty $(= $default)? $(=> $rule)? ; )*
                            })?
                        ),
                    },
                )+],
            };
        }

        impl $crate::words::Words for $Name {
            const TYPE: $crate::schema::Type = $crate::schema::Type::Enum(&$Name::DEF);

            fn read(
                reader: &mut $crate::read::Reader<'_>,
                item: $crate::tree::Item<'_, '_>,
                _at: &'static $crate::schema::FieldDef,
            ) -> Option<Self> {
                let chosen = reader.variant(item, &Self::DEF)?;
                Self::of_chosen(reader, &chosen)
            }

            fn form(&self, all: bool) -> $crate::form::Form {
                match self {$(
                    $Name::$Variant $(($crate::words::binding!(content, $inner)))? $({ $($field),* })? => {
                        $crate::words::write_content!(
                            all, $Variant $(, $crate::words::binding!(content, $inner))?
                            $({ $( $field : $ty $(= $default)? ; )* })?
                        )
                    }
                )+}
            }
        }

        impl $Name {
            /// Reads what stands in the brackets of a kind that was found.
            pub(crate) fn of_chosen(
                reader: &mut $crate::read::Reader<'_>,
                chosen: &$crate::read::Chosen<'_, '_>,
            ) -> Option<Self> {
                $(
                    if chosen.variant.name == stringify!($Variant) {
                        return $crate::words::read_content!(
                            reader, chosen, $Name $Variant $(($inner))? $({ $( $field : $ty $(= $default)? ; )* })?
                        );
                    }
                )+
                None
            }
        }
    };
}

/// A choice between kinds that are types of their own, one line each: what is told of a kind stands at its type. What
/// is asked of all of them is a trait, which `words` gives.
macro_rules! scene_kinds {
    (
        $(#[doc = $doc:literal])+
        $vis:vis enum $Name:ident, $noun:literal, by $Trait:ident {
            $( $Variant:ident($inner:ty); )+
        }
    ) => {
        $(#[doc = $doc])+
        #[derive(Clone, Debug, PartialEq)]
        $vis enum $Name {
            $( #[doc = concat!("[`", stringify!($Variant), "`].")] $Variant($inner), )+
        }

        impl $Name {
            pub(crate) const DEF: $crate::schema::EnumDef = $crate::schema::EnumDef {
                name: stringify!($Name),
                noun: $noun,
                doc: &[$($doc),+],
                variants: &[$( $crate::schema::VariantDef::of_struct(<$inner as $crate::words::Words>::TYPE), )+],
            };
            /// By kind: names of other programs, an example.
            pub(crate) const TOLD: &[(&str, &[&str], &str)] = &[$((
                stringify!($Variant),
                <$Variant as $crate::words::Told>::ALSO,
                <$Variant as $crate::words::Told>::EXAMPLE,
            ),)+];

            fn words(&self) -> &dyn $Trait {
                match self {$( $Name::$Variant(words) => std::borrow::Borrow::<$Variant>::borrow(words), )+}
            }
        }

        impl $crate::words::Words for $Name {
            const TYPE: $crate::schema::Type = $crate::schema::Type::Enum(&$Name::DEF);

            fn read(
                reader: &mut $crate::read::Reader<'_>,
                item: $crate::tree::Item<'_, '_>,
                _at: &'static $crate::schema::FieldDef,
            ) -> Option<Self> {
                let chosen = reader.variant(item, &Self::DEF)?;
                $(
                    if chosen.variant.name == stringify!($Variant) {
                        return reader.content::<$inner>(&chosen).map($Name::$Variant);
                    }
                )+
                None
            }

            fn form(&self, all: bool) -> $crate::form::Form {
                match self {$(
                    $Name::$Variant(content) => {
                        $crate::words::write_content!(all, $Variant, content)
                    }
                )+}
            }
        }
    };
}

macro_rules! content {
    ($Variant:ident [] $docs:tt []) => {
        $crate::schema::Content::Unit
    };
    ($Variant:ident [] [$($doc:literal),+] [$($rule:expr)?] ($inner:ty)) => {
        match <$inner as $crate::words::Words>::TYPE {
            $crate::schema::Type::Struct(def) => $crate::schema::Content::Struct(def),
            kind => $crate::schema::Content::Value($crate::schema::FieldDef {
                name: "",
                noun: concat!("the value of ", stringify!($Variant)),
                doc: &[$($doc),+],
                kind,
                rule: $crate::words::rule!($($rule)?),
                default: None,
            }),
        }
    };
    ($Variant:ident [$noun:literal $($bare:ident)?] [$($doc:literal),+] [] { $($fields:tt)* }) => {
        $crate::schema::Content::Struct(&$crate::schema::StructDef {
            name: stringify!($Variant),
            noun: $noun,
            doc: &[$($doc),+],
            fields: $crate::words::field_defs!($noun; $($fields)*),
            bare: $crate::words::bare!($($bare)?),
            exactly_one: &[],
        })
    };
}

macro_rules! bare {
    () => {
        None
    };
    ($bare:ident) => {
        Some(stringify!($bare))
    };
}

macro_rules! read_content {
    ($reader:ident, $chosen:ident, $Name:ident $Variant:ident) => {{
        $reader.unit($chosen)?;
        Some($Name::$Variant)
    }};
    ($reader:ident, $chosen:ident, $Name:ident $Variant:ident ($inner:ty)) => {
        $reader.content::<$inner>($chosen).map($Name::$Variant)
    };
    ($reader:ident, $chosen:ident, $Name:ident $Variant:ident
        { $( $field:ident : $ty:ty $(= $default:expr)? ; )* }) => {{
        let mut fields = $reader.variant_fields($chosen)?;
        $( let $field: Option<$ty> = $reader.field(&mut fields, $crate::words::default_value!($ty $(, $default)?)); )*
        Some($Name::$Variant { $($field: $field?,)* })
    }};
}

/// The pattern `name`, whatever type stands beside it.
macro_rules! binding {
    ($name:ident, $inner:ty) => {
        $name
    };
}

macro_rules! write_content {
    ($all:ident, $Variant:ident) => {{
        let _ = $all;
        $crate::form::Form::word(stringify!($Variant))
    }};
    ($all:ident, $Variant:ident, $content:expr) => {
        $crate::form::Form::Variant {
            name: stringify!($Variant),
            content: Some(Box::new($crate::words::Words::form($content, $all))),
        }
    };
    ($all:ident, $Variant:ident { $( $field:ident : $ty:ty $(= $default:expr)? ; )* }) => {{
        let mut fields = Vec::new();
        $(
            if $all || !$crate::words::is_default!($field, $ty $(, $default)?) {
                let value = $crate::words::Words::form($field, $all);
                $crate::form::Entry::push(&mut fields, stringify!($field), value);
            }
        )*
        let content = $crate::form::Form::Struct { name: stringify!($Variant), fields };
        $crate::form::Form::Variant { name: stringify!($Variant), content: Some(Box::new(content)) }
    }};
}

/// A choice between bare words, the first of which is the default.
macro_rules! scene_words {
    (
        $(#[doc = $doc:literal])+
        $vis:vis enum $Name:ident, $noun:literal {
            $(#[doc = $ddoc:literal])+
            $Default:ident
            $(, $(#[doc = $vdoc:literal])+ $Variant:ident )* $(,)?
        }
    ) => {
        $(#[doc = $doc])+
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
        $vis enum $Name {
            $(#[doc = $ddoc])+
            #[default]
            $Default,
            $( $(#[doc = $vdoc])+ $Variant, )*
        }

        impl $Name {
            pub(crate) const DEF: $crate::schema::EnumDef = $crate::schema::EnumDef {
                name: stringify!($Name),
                noun: $noun,
                doc: &[$($doc),+],
                variants: &[
                    $crate::schema::VariantDef {
                        name: stringify!($Default),
                        doc: &[$($ddoc),+],
                        content: $crate::schema::Content::Unit,
                    },
                    $( $crate::schema::VariantDef {
                        name: stringify!($Variant),
                        doc: &[$($vdoc),+],
                        content: $crate::schema::Content::Unit,
                    }, )*
                ],
            };
        }

        impl $crate::words::Words for $Name {
            const TYPE: $crate::schema::Type = $crate::schema::Type::Enum(&$Name::DEF);

            fn read(
                reader: &mut $crate::read::Reader<'_>,
                item: $crate::tree::Item<'_, '_>,
                _at: &'static $crate::schema::FieldDef,
            ) -> Option<Self> {
                let chosen = reader.variant(item, &Self::DEF)?;
                reader.unit(&chosen)?;
                match chosen.variant.name {
                    $( name if name == stringify!($Variant) => Some($Name::$Variant), )*
                    _ => Some($Name::$Default),
                }
            }

            fn form(&self, _all: bool) -> $crate::form::Form {
                match self {
                    $Name::$Default => $crate::form::Form::word(stringify!($Default)),
                    $( $Name::$Variant => $crate::form::Form::word(stringify!($Variant)), )*
                }
            }
        }
    };
}

pub(crate) use {
    bare, binding, content, default_form, default_value, field_defs, is_default, read_content, rule, scene_enum,
    scene_kinds, scene_struct, scene_words, write_content,
};
