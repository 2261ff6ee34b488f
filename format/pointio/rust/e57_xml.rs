// SPDX-License-Identifier: Apache-2.0
//! What an XML section must not have before it is given to the parser, whose time grows with the square of a tag's
//! attributes, whose memory with that of nested namespaces, and whose stack with the depth of elements.

/// Tags of E57 have a few attributes, and the root a namespace for each extension.
const LONGEST_TAG: usize = 4096;
const MOST_NAMESPACES: usize = 256;
/// Elements within elements: those of E57 and its extensions are some ten deep.
const DEEPEST: usize = 256;

/// The bytes up to and with `end`, or all.
fn length_to(text: &[u8], end: &[u8]) -> usize {
    text.windows(end.len()).position(|window| window == end).map_or(text.len(), |at| at + end.len())
}

/// Of a tag, whose attributes may hold a '>' in quotes.
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
