/* SPDX-License-Identifier: MIT
 *
 * text_lower - a text in lower case for a search: a place in it is a place in the text.
 */
#ifndef KIT_TEXT_LOWER_H
#define KIT_TEXT_LOWER_H

/** text_lower - each character in lower case; as many characters as @text, which is UTF-8, not
 * always as many bytes. Owns: g_free. */
char *text_lower(const char *text);

#endif
