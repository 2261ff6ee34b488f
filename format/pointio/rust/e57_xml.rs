// SPDX-License-Identifier: Apache-2.0
//! Limits of the XML section, checked before parsing: the parser takes quadratic time in the attributes of a tag, quadratic
//! memory in nested namespaces, and stack in the depth of elements.

/// Tags of E57 have a few attributes; the root has a namespace for each extension.
const LONGEST_TAG: usize = 4096;
const MOST_NAMESPACES: usize = 256;
/// Nesting of elements, which is about ten in E57 and its extensions.
const DEEPEST: usize = 256;

/// The number of bytes up to and including `end`, or all.
fn length_to(text: &[u8], end: &[u8]) -> usize {
    text.windows(end.len()).position(|window| window == end).map_or(text.len(), |at| at + end.len())
}

/// The length of a tag, whose attributes may contain '>' in quotes.
fn tag_length(tag: &[u8]) -> usize {
    let mut quote = None;
    for (i, &byte) in tag.iter().enumerate() {
        match (quote, byte) {
            (None, b'>') => return i + 1,
            (None, b'"' | b'\'') => quote = Some(byte),
            (Some(open), _) if open == byte => quote = None,
            _ => {}
        }
    }
    tag.len()
}

pub fn check(xml: &[u8]) -> Result<(), String> {
    let mut rest = xml;
    let (mut namespaces, mut depth) = (0, 0usize);
    while let Some(start) = rest.iter().position(|&byte| byte == b'<') {
        rest = &rest[start..];
        let length = match rest {
            [b'<', b'!', b'-', b'-', ..] => length_to(rest, b"-->"),
            [b'<', b'!', b'[', ..] => length_to(rest, b"]]>"),
            [b'<', b'?', ..] => length_to(rest, b"?>"),
            _ => {
                let tag = &rest[..tag_length(rest)];
                if tag.len() > LONGEST_TAG {
                    return Err(format!("is broken: its XML section has a tag of more than {LONGEST_TAG} bytes"));
                }
                if tag.starts_with(b"</") {
                    depth = depth.saturating_sub(1);
                } else if !tag.ends_with(b"/>") {
                    depth += 1;
                }
                namespaces += tag.windows(5).filter(|window| window == b"xmlns").count();
                tag.len()
            }
        };
        if namespaces > MOST_NAMESPACES {
            return Err(format!("declares more than {MOST_NAMESPACES} namespaces"));
        }
        if depth > DEEPEST {
            return Err(format!("nests more than {DEEPEST} elements"));
        }
        rest = &rest[length..];
    }
    Ok(())
}
