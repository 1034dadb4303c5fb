/* SPDX-License-Identifier: MIT
 *
 * image - the process image: %I %Q %M …, a program's data, and forcing.
 *
 * One block of memory. The program sees it; drivers see only the areas, packed as IEC
 * 61131-3 has them. Each bit that the program uses has its own byte; bits are packed
 * and unpacked at the edges of the scan (image_begin, image_end).
 */
#ifndef SCAN_IMAGE_H
#define SCAN_IMAGE_H

#include "engine/scan/code.h"

/* A small board, and a static ladderd for another machine, are built without scan/still.h: each scan
 * runs the whole program. */
#if defined(RUNGBOARD_SMALL) || defined(RUNGBOARD_WHOLE)
#define HAS_STILL 0
#else
#define HAS_STILL 1
#endif

/* Where a value is: a typed place in memory, or one bit of an area. */
struct location {
	enum iec_type type;     /* IEC_NONE: nowhere                         */
	enum iec_area area;     /* AREA_NONE: at `where` in memory           */
	uint32_t where;         /* offset in memory, or bit number of area   */
	bool constant;
	uint8_t number, first;  /* of a part, Word.3: the type of the number at `where`, whose bits
	                           from `first` on it is. IEC_NONE: it is no part. Always constant */
};

/* A board that knows no names knows no parts. */
#ifdef RUNGBOARD_SMALL
#define LOCATION_IS_PART(at) false
#else
#define LOCATION_IS_PART(at) ((at).number != IEC_NONE)
#endif
/** location_whole - where the number is of which @at is a part; else @at. Scan-safe: yes. */
static inline struct location location_whole(struct location at)
{
	return !LOCATION_IS_PART(at) ? at :
		(struct location){ .type = (enum iec_type)at.number, .where = at.where };
}

struct force {
	struct location at;
	union iec_value value, aside; /* aside: what the program wrote        */
};

struct image {
	uint8_t *memory;        /* image_memory_size() bytes                  */
	const struct program *program;
	struct force force[LIMIT_FORCES];
	int force_count;
	bool changed;           /* somebody outside of the program wrote a value: see still.h */
};

/** image_memory_size - bytes that image_init wants for @program. */
size_t image_memory_size(const struct program *program);

/**
 * image_init - the image as a cold start has it
 * @memory: caller's, image_memory_size() bytes, aligned to 8; borrowed
 *
 * All zero but for initial values. Forces are gone.
 * Owns: nothing.   Scan-safe: yes.   Fails: never.
 */
void image_init(struct image *image, const struct program *program, void *memory);

/** image_begin - the edge before the program: applies forces, unpacks bits of areas. */
void image_begin(struct image *image);
/** image_end - the edge behind the program: applies forces, packs bits of areas. */
void image_end(struct image *image);

/* Whether bits of an area come from outside: image_begin() unpacks them, image_end() packs the
 * others. */
static inline bool image_reads(const struct code_bits *bits)
{
	return iec_area_row((enum iec_area)bits->area)->access == ACCESS_READ;
}
/** image_unpack, image_pack - some of the bits that live a byte each. Scan-safe: yes. */
void image_unpack(struct image *image, const struct code_bits *bits);
void image_pack(struct image *image, const struct code_bits *bits);

/**
 * image_area - the packed bytes of an area, for drivers
 *
 * Their number is in image->program->areas.bytes. image_begin reads inputs from it;
 * image_end writes outputs to it. Only bytes of inputs and system words may be written so.
 * Owns: the image. Scan-safe: yes.
 */
uint8_t *image_area(struct image *image, enum iec_area area);

/* One bit of an area between scans. @bit from the area's start; outside the area:
 * false, nothing changes. Scan-safe: yes. */
bool image_get_bit(const struct image *image, enum iec_area area, uint32_t bit);
bool image_set_bit(struct image *image, enum iec_area area, uint32_t bit,
		   bool value);

/** image_locate - where a direct address lives in this image; type IEC_NONE: outside its
 * areas. Scan-safe: yes. */
struct location image_locate(const struct image *image, struct iec_addr addr);
/** image_find - where a variable or address lives, by its name in the source:
 * `Motor`, `Main.Motor`, `Runout.Q`, `Table[3]`, `%QX0.0`, `Q3`; or a name that VAR_ACCESS
 * gives it. type IEC_NONE: unknown.
 * Scan-safe: no. */
struct location image_find(const struct image *image, const char *name,
			   size_t len);

/** image_bits - the bits that a variable has in a process image, whose areas follow one another. Fails:
 * false: it is no input, output or other address. Scan-safe: yes. */
static inline bool image_bits(const struct program *program, struct location at, uint32_t *first,
			      uint32_t *count)
{
	at = location_whole(at);
	if (at.type == IEC_NONE || at.constant)
		return false;
	*first = at.area != AREA_NONE ? 8 * program->areas.at[at.area] + at.where : 8 * at.where;
	*count = at.area != AREA_NONE ? 1 : 8 * (uint32_t)iec_type_row(at.type)->size;
	return at.area != AREA_NONE || at.where < program->areas.size;
}

/* A value between scans. The next image_begin (inputs) or the program sees a value that
 * was set. Scan-safe: yes. */
union iec_value image_get(const struct image *image, struct location at);
bool image_set(struct image *image, struct location at, union iec_value value);

/**
 * image_force - hold a value at both edges of every scan until image_unforce()
 *
 * Forced from this call on. The value that the program or a driver writes meanwhile is
 * kept aside and reappears on release.
 * Owns: nothing. Scan-safe: yes.
 * Fails: false if @at is nowhere, constant or a STRING, or LIMIT_FORCES are held.
 */
bool image_force(struct image *image, struct location at, union iec_value value);
bool image_unforce(struct image *image, struct location at);
bool image_is_forced(const struct image *image, struct location at);

/* A declared variable, or an instance as a whole. */
struct declared_name {
	const char *name, *pou; /* in the program; pou "": a global           */
	struct code_bounds array; /* of an array; then `name` ends with its bounds, */
	uint32_t stride;        /* bytes to the next one; of bits of areas 1  */
	struct location at;     /* type IEC_NONE: an instance, at `where`     */
	uint32_t flags;         /* enum symbol_flag                           */
};
/**
 * image_next_declared - steps through all symbols of a program
 * @cursor: {0} to begin with
 *
 * Owns: nothing.   Scan-safe: no.   Fails: false behind the last one.
 */
struct declared_cursor {
	uint32_t index, group, string;
	bool memories;          /* set before: also give memories of edges, which have */
};
bool image_next_declared(const struct program *program,
			 struct declared_cursor *cursor,
			 struct declared_name *out);
/** declared_element - element @number of an array, 0-based. Scan-safe: no. */
struct location declared_element(const struct declared_name *array,
				 uint32_t number);

/**
 * image_next_access - steps through the lines of VAR_ACCESS: names for operators and gateways
 * @cursor: {0} to begin with
 * @out:    flags has SYMBOL_EXPORTED, and SYMBOL_WRITABLE if it is READ_WRITE; pou ""
 *
 * Owns: nothing.   Scan-safe: no.   Fails: false behind the last one.
 */
bool image_next_access(const struct program *p, struct declared_cursor *cursor,
		       struct declared_name *out);
/** image_as_access - whether a symbol is such a line; then @symbol becomes it. Scan-safe: yes. */
bool image_as_access(struct declared_name *symbol);

/** image_find_array - the array of this name; names as in image_find.
 * Scan-safe: no. Fails: false if there is none. */
bool image_find_array(const struct image *image, const char *name, size_t len,
		      struct declared_name *out);

/** image_find_members - the same member of all elements of an array, such as
 * `Recipes[1..5].Speed`
 * @head: "Recipes"   @tail: ".Speed"
 * @out: bounds, stride and place of the first one; no name
 *
 * Scan-safe: no.   Fails: false if there is none. */
bool image_find_members(const struct image *image, const char *head, size_t len,
			const char *tail, size_t tail_len, struct declared_name *out);

/* The symbols of the image, for displays and recordings of variables. */
struct symbol {
	const char *name;       /* "Motor", "Runout.Q"; lives with the program */
	struct location at;
	uint32_t flags;         /* enum symbol_flag                           */
	bool is_input;          /* FB input pin                               */
	const char *block;      /* word of the FB whose pin it is, or NULL    */
	uint32_t elements;      /* elements of an array that an instance stores; */
};
/**
 * image_next_symbol - steps through all declared variables: instances pin by pin, as
 * "Name.PIN", arrays element by element, as "Name[3]"
 * @cursor: {0} to begin with; its text buffer backs symbol.name until the next call
 *
 * Owns: nothing. Scan-safe: no. Fails: false behind the last one.
 */
struct symbol_cursor {
	struct declared_cursor declared;
	uint32_t pin;           /* or element                                 */
	bool access;            /* set before: the lines of VAR_ACCESS instead */
	bool whole;             /* set before: always put the POU before the name, */
	char text[2 * LIMIT_NAME + 64];
};
bool image_next_symbol(const struct image *image, struct symbol_cursor *cursor,
		       struct symbol *out);
#endif
