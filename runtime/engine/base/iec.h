/* SPDX-License-Identifier: MIT
 *
 * iec - the types, values, areas and direct addresses of IEC 61131-3.
 *
 * Types and areas are rows of catalog.def. It knows nothing of programs, and it
 * reads no clock: a TIME is 64-bit nanoseconds inside.
 */
#ifndef BASE_IEC_H
#define BASE_IEC_H

#include "engine/base/diag.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* IEC 61131-3 table 10; the order is the order of implicit widening. */
enum iec_type {
	IEC_NONE,
#define TYPE(id, ctype, size, class, low, high) IEC_##id,
#define TEXT_TYPE(id, class) IEC_##id,
#include "engine/catalog.def"
	IEC_TYPE_COUNT
};

/* Generic types (IEC 61131-3 figure 5) are sets of these classes. */
enum iec_class {
	CLASS_BOOL = 1, CLASS_BITS = 2, CLASS_SIGNED = 4, CLASS_UNSIGNED = 8,
	CLASS_REAL = 16, CLASS_TIME = 32, CLASS_TOD = 64, CLASS_DATE = 128,
	CLASS_DT = 256, CLASS_STRING = 512,
};
#define ANY_INT   (CLASS_SIGNED | CLASS_UNSIGNED)
#define ANY_NUM   (ANY_INT | CLASS_REAL)
#define ANY_MAGNITUDE (ANY_NUM | CLASS_TIME)
#define ANY_BIT   (CLASS_BOOL | CLASS_BITS)
#define ANY_DATE (CLASS_TOD | CLASS_DATE | CLASS_DT)
#define ANY_SIMPLE (ANY_MAGNITUDE | ANY_BIT | ANY_DATE) /* of fixed size    */
#define ANY_ELEMENTARY (ANY_MAGNITUDE | ANY_BIT | ANY_DATE | CLASS_STRING)

/* A STRING in memory, with its own bound: bytes of UTF-8 or any other code, counted
 * one by one, not NUL-ended. Aligned to 4. */
struct iec_string {
	uint16_t capacity, length;
	char text[];
};
#define IEC_STRING_MOST    255u /* bytes a STRING can hold                    */
#define IEC_STRING_DEFAULT 80u  /* of a STRING declared without [n]           */
/* Room for a text of any length. */
struct iec_text {
	uint32_t word[(sizeof(struct iec_string) + IEC_STRING_MOST + 3) / 4];
};
#define IEC_VALUE_TEXT (3 * IEC_STRING_MOST + 3) /* of any value, iec_value_print() */

/* A value of any elementary type; its class says which member is used: r for
 * CLASS_REAL, s for CLASS_STRING, i for all others (BOOL 0/1, bits and unsigned
 * zero-extended, signed sign-extended, TIME in ns; LWORD and ULINT as their bits). */
union iec_value {
	int64_t i;
	double r;
	const struct iec_string *s; /* borrowed                               */
};

struct iec_type_row {
	const char *word;    /* "INT"                                          */
	uint8_t size;        /* bytes; BOOL 1; STRING: of its head              */
	uint16_t class;      /* one enum iec_class                             */
	int64_t low, high;   /* smallest and largest value of what i holds; of
				LWORD and ULINT see iec_is_wide()              */
};
/** iec_type_row - the row of a type; IEC_NONE has an empty one. */
const struct iec_type_row *iec_type_row(enum iec_type type);
/** iec_type_find - IEC_NONE if @word (any case) names no elementary type. Short and
 * long names of ed. 3 too: TOD, DT, LTIME, LTOD, LDATE, LDT. */
enum iec_type iec_type_find(const char *word, size_t len);
/** iec_is_wide - unsigned 64 bits (LWORD, ULINT): i holds its bits and must be compared
 * and divided as uint64_t.   Scan-safe: yes. */
bool iec_is_wide(enum iec_type type);
/** iec_type_size - bytes in memory, of a STRING of @capacity with its head and padding
 * to 4.   Scan-safe: yes. */
uint32_t iec_type_size(enum iec_type type, uint32_t capacity);

/**
 * iec_can_widen - whether a value of type @from may be used as @to without a conversion
 *
 * Only when every value of @from is a value of @to (IEC 61131-3 ed. 3 figure 12):
 * SINT→INT→DINT→LINT, USINT→UINT→UDINT→ULINT, unsigned into a larger signed, up to 16
 * bits into REAL, up to 32 and REAL into LREAL, BYTE→WORD→DWORD→LWORD. The type itself
 * always. Scan-safe: yes.
 */
bool iec_can_widen(enum iec_type from, enum iec_type to);

enum iec_area {
	AREA_NONE,
#define AREA(id, letters, least, usual, most, access, doc) AREA_##id,
#include "engine/catalog.def"
	AREA_COUNT
};
enum iec_access { ACCESS_READ, ACCESS_WRITE }; /* what a program may do */

struct iec_area_row {
	char letters[4];     /* "I"                                            */
	uint32_t least, usual, most; /* bytes; a project says which, areas.h   */
	enum iec_access access;
};
const struct iec_area_row *iec_area_row(enum iec_area area);
/** iec_area_is_io - whether it holds inputs or outputs, also analog ones and those of
 * expansion modules.   Scan-safe: yes. */
bool iec_area_is_io(enum iec_area area);

struct iec_addr {
	enum iec_area area : 8;  /* AREA_NONE: no address                          */
	uint8_t bits;        /* 1, 8, 16, 32 or 64                             */
	uint8_t bit;         /* 0..7, of bits == 1                             */
	uint32_t byte;       /* from the start of the area                     */
};

enum iec_addr_result { ADDR_OK, ADDR_NONE, ADDR_RANGE };
/**
 * iec_addr_parse - a direct address such as %IX0.3, %MW4, I3, Q10, V0.3, SM0.5
 *
 * Short forms (without `%`) too: I3 is bit 3 of the inputs, AI3 the fourth analog input.
 * Returns ADDR_NONE when the text is no address, ADDR_RANGE when it is one that
 * no area can have (a bit above 7, beyond the most bytes). areas_have() tells whether a
 * program has it.   Scan-safe: yes.
 */
enum iec_addr_result iec_addr_parse(const char *text, size_t len,
				    struct iec_addr *out);
/**
 * iec_addr_fault - iec_addr_parse() that says why not
 *
 * DIAG_COUNT: it is an address. DIAG_NOT_ADDRESS; DIAG_BAD_BIT: a bit above 7;
 * DIAG_BAD_ADDRESS: beyond the most bytes.   Scan-safe: yes.
 */
enum diag_id iec_addr_fault(const char *text, size_t len, struct iec_addr *out);
/** iec_addr_print - canonical "%QX1.2"; returns as snprintf. */
int iec_addr_print(struct iec_addr addr, char *out, size_t size);
/** iec_addr_type - BOOL, BYTE, WORD, DWORD or LWORD by its width. */
enum iec_type iec_addr_type(struct iec_addr addr);

/**
 * iec_load, iec_store - a typed value in memory (little-endian, any alignment)
 *
 * iec_store keeps the low bits of a value that does not fit; of a STRING what the
 * capacity in memory has room for. iec_load gives a STRING in place (aligned to 4).
 * Scan-safe: yes.
 */
union iec_value iec_load(const void *memory, enum iec_type type);
void iec_store(void *memory, enum iec_type type, union iec_value value);

/** iec_text_init - @room as a text of @length bytes, which the caller fills in.
 * Scan-safe: yes. */
struct iec_string *iec_text_init(struct iec_text *room, uint16_t length);

/**
 * iec_value_print - a value as traces show it
 *
 * BOOL 0 or 1; integers and bit strings decimal; REAL and LREAL the shortest text that
 * reads back; TIME in milliseconds with as many decimals as it takes; dates as their
 * literal without its type, 2026-11-21-08:30:00; STRING in ' with $ escapes.
 * Returns as snprintf.   Scan-safe: no.
 */
int iec_value_print(enum iec_type type, union iec_value value, char *out,
		    size_t size);

/* Days since 1970-01-01 of the Gregorian calendar, and back.   Scan-safe: yes. */
int64_t iec_days(int year, int month, int day_of_month);
void iec_civil(int64_t day, int *year, int *month, int *day_of_month);
/** iec_date - a DATE of the calendar; false: it has no such day, or 64 bits do not
 * reach it (1677 to 2262).   Scan-safe: yes. */
bool iec_date(int64_t year, int64_t month, int64_t day_of_month, int64_t *ns);

#endif
