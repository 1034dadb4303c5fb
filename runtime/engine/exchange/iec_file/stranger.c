/* SPDX-License-Identifier: MIT
 *
 * stranger - names a file that is no IEC text, by its first bytes.
 *
 * It opens nothing and follows no structure: a message needs no more.
 */
#include "engine/exchange/iec_file/iec_file_parts.h"

#include "engine/base/ascii.h"
#include "engine/base/lex.h"

#include <string.h>

#define LOOK_MOST 4096 /* bytes that are searched for a word                 */

/* Files that begin with fixed bytes. */
static const struct {
	const char *begin;
	size_t len;
	enum diag_id id;
	const char *arg;
} begins[] = {
	{ "\x89PNG", 4, DIAG_IS_PICTURE, "PNG" },
	{ "\xff\xd8\xff", 3, DIAG_IS_PICTURE, "JPEG" },
	{ "GIF8", 4, DIAG_IS_PICTURE, "GIF" },
	{ "BM\x36", 3, DIAG_IS_PICTURE, "BMP" },
	{ "II*\0", 4, DIAG_IS_PICTURE, "TIFF" },
	{ "MM\0*", 4, DIAG_IS_PICTURE, "TIFF" },
	{ "RIFF", 4, DIAG_IS_PICTURE, "WebP" },
	{ "\x1f\x8b", 2, DIAG_IS_PACKED, "gzip" },
	{ "PK\3\4", 4, DIAG_IS_PACKED, "zip" },
	{ "BZh", 3, DIAG_IS_PACKED, "bzip2" },
	{ "\xfd" "7zXZ", 5, DIAG_IS_PACKED, "xz" },
	{ "7z\xbc\xaf", 4, DIAG_IS_PACKED, "7z" },
	{ "\x28\xb5\x2f\xfd", 4, DIAG_IS_PACKED, "zstd" },
	{ "Rar!", 4, DIAG_IS_PACKED, "RAR" },
	{ "\x7f" "ELF", 4, DIAG_IS_BINARY, "ELF" },
	{ "MZ\x90", 3, DIAG_IS_BINARY, "EXE" },
	{ "%PDF", 4, DIAG_IS_BINARY, "PDF" },
	{ "\xd0\xcf\x11\xe0", 4, DIAG_IS_BINARY, "OLE" },
	{ "LDmicro", 7, DIAG_IS_LDMICRO, "" },
};

/* The first words of texts of a Siemens controller: STL and SCL sources. */
static const char *const siemens[] = {
	"ORGANIZATION_BLOCK", "DATA_BLOCK", "SUBROUTINE_BLOCK", "NETWORK", "TITLE",
};

/* Whether @word stands in the first @len bytes. */
static bool has(const char *bytes, size_t len, const char *word)
{
	const size_t size = strlen(word);

	if (len > LOOK_MOST)
		len = LOOK_MOST;
	for (size_t i = 0; i + size <= len; i++)
		if (bytes[i] == *word && memcmp(bytes + i, word, size) == 0)
			return true;
	return false;
}

static enum diag_id find_xml(const char *bytes, size_t len, const char **arg)
{
	if (has(bytes, len, "plcopen.org") || has(bytes, len, "<pou"))
		return DIAG_IS_PLCOPEN;
	if (has(bytes, len, "<svg")) {
		*arg = "SVG";
		return DIAG_IS_PICTURE;
	}
	*arg = has(bytes, len, "<html") || has(bytes, len, "<HTML") ? "HTML" :
	       has(bytes, len, "RSLogix5000Content") ? "Logix Designer L5X" :
	       has(bytes, len, "<ExportFile") || has(bytes, len, "<ExportedObject") ? "CODESYS 3" :
	       has(bytes, len, "SW.Blocks") ? "TIA Portal" : "XML";
	return DIAG_IS_XML;
}

static enum diag_id find_json(const char *bytes, size_t len, const char **arg)
{
	if (has(bytes, len, "plc-project") || has(bytes, len, "\"pous\"") ||
	    has(bytes, len, "\"rungs\""))
		return DIAG_IS_OPENPLC;
	*arg = "JSON";
	return DIAG_IS_XML;
}

/* A byte that no text has, in the first ones. */
static bool is_binary(const char *bytes, size_t len)
{
	for (size_t i = 0; i < len && i < LOOK_MOST; i++)
		if ((unsigned char)bytes[i] < ' ' && !strchr("\t\n\r\f", bytes[i]))
			return true;
	return len > 0 && memchr(bytes, 0, len < LOOK_MOST ? len : LOOK_MOST) != NULL;
}

/* Behind blanks and a byte order mark. */
static const char *first_of(const char *bytes, size_t len)
{
	size_t at = len >= 3 && memcmp(bytes, "\xef\xbb\xbf", 3) == 0 ? 3 : 0;

	while (at < len && bytes[at] && strchr(" \t\r\n", bytes[at]))
		at++;
	return bytes + at;
}

bool stranger_is_siemens(const char *bytes, size_t len)
{
	struct lex lex;

	lex_init(&lex, bytes, len);
	lex_next(&lex);
	if (!lex_is(&lex, "FUNCTION_BLOCK") && !lex_is(&lex, "FUNCTION") && !lex_is(&lex, "TYPE"))
		return false;
	if (lex_next(&lex) == TOKEN_STRING)
		return true;
	if (!lex_is(&lex, "FB") && !lex_is(&lex, "FC"))
		return false;
	return lex_next(&lex) == TOKEN_NUMBER;
}

enum diag_id stranger_find(const char *bytes, size_t len, const char **arg)
{
	const char *first = first_of(bytes, len);
	const size_t left = len - (size_t)(first - bytes);

	*arg = "";
	for (size_t i = 0; i < sizeof(begins) / sizeof(*begins); i++)
		if (len >= begins[i].len && !memcmp(bytes, begins[i].begin, begins[i].len)) {
			*arg = begins[i].arg;
			return begins[i].id;
		}
	for (size_t i = 0; i < sizeof(siemens) / sizeof(*siemens); i++) {
		const size_t word = ascii_prefix(siemens[i], first, left);

		if (word && (word == left || strchr(" \t\r\n=\"", first[word]))) {
			*arg = siemens[i];
			return DIAG_IS_SIEMENS;
		}
	}
	if (stranger_is_siemens(bytes, len)) {
		*arg = "S7";
		return DIAG_IS_SIEMENS;
	}
	if (left && *first == '<')
		return find_xml(first, left, arg);
	if (left && (*first == '{' || *first == '[') && has(first, left, "\""))
		return find_json(first, left, arg);
	if (is_binary(bytes, len)) {
		*arg = "";
		return DIAG_IS_BINARY;
	}
	return DIAG_COUNT;
}
