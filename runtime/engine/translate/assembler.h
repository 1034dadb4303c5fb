/* SPDX-License-Identifier: MIT
 *
 * assembler - shared by the parts of the assembler.
 *
 * Private to translate/. layout.c places everything, fuse.c keeps bits as truth tables
 * until they must be stored, assemble_unit.c walks the lists, pack_image.c writes the
 * image.
 */
#ifndef TRANSLATE_ASSEMBLER_H
#define TRANSLATE_ASSEMBLER_H

#include "engine/model/init.h"
#include "engine/translate/translate.h"

/* Where a value lies in data memory. */
struct spot {
	enum iec_type type;
	uint32_t offset;
	bool packed;        /* one bit of the byte at offset                  */
	uint8_t bit;
};

/* Vectors that grow in the arena of the result. */
struct words { uint32_t *word; int count; };

/* Bits in memory for values that wait within a statement. */
struct slots { uint32_t *slot; int count; };

/* A bit that has not been stored: a truth table of up to three BOOLs. */
struct bits {
	uint8_t count, table;
	uint32_t leaf[3];
};

/* A pointer with an initial value; its variable may have no place yet. */
struct pointing { uint32_t offset; const struct var_points *points; };

struct assembler {
	struct translation *translation;
	const struct areas *areas; /* of the project                          */
	struct arena *arena;
	bool failed;

	/* layout */
	struct pointing *pointing;
	int pointing_count;
	struct code_run *run;
	int run_count, run_core;   /* run_core: data of the part that runs unwatched */
	struct code_bits *bit_run;
	int bit_run_count;
	uint32_t data_size, retain_offset, retain_size;
	uint32_t **offset;         /* by table (0 globals, unit + 1), index   */
	uint8_t *byte_packed;      /* a byte an area byte                     */
	struct words init;         /* offset, bytes, data …                   */
	int init_last, init_end;   /* the record that may go on; its end      */
	struct init_walk *walk;    /* NULL until it is needed                 */
	uint32_t *constant;        /* open hash: index + 1 in constant_key    */
	struct constant_key *constant_key;
	int constant_count;
	uint32_t constant_mask;
	struct text_key *text_key; /* constant texts; few, so searched         */
	int text_count;
	uint8_t *pin_writes;       /* by instance pin number                  */
	uint32_t **first_pin;      /* by table, index: number of its pin 0    */
	struct frame *frame;       /* by unit                                 */
	bool watching;             /* there will be an instrumented section   */
	bool listing;              /* in which generated lists keep results   */
	uint32_t **power;          /* by table, index: where an instance's
				      power lies; 0: nowhere. NULL: unwatched */
	uint32_t not_run;          /* as many FALSE as the longest list has lines */

	/* output of one section */
	struct words *text;
	struct words code, watch;
	int open_lut;              /* word index of a LUT that may be extended; -1 */
	int open_cmp;              /* of a comparison that ends the code; -1  */
	int open_bit;              /* word with the slot of the bit that the last
				      instruction makes; -1: it makes none    */
	uint32_t likely[4];        /* offsets of BOOLs that are hardly ever FALSE */
	uint32_t likely_count;     /* noted so far                            */
	int op_at, op_before;      /* words of the last instruction and the one before it */
	int open_number;           /* likewise of a number that it always stores  */
	struct code_place *place;
	int place_count;
	struct code_program *entry;
	struct code_task *task;    /* by priority                             */
	int task_count;
	struct words call;

	/* safe points of programs whose tasks can be interrupted */
	bool *pointed;             /* by unit                                 */
	bool *called;              /* by unit: a CAL runs it, of another one  */
	struct point *point;       /* of all units, in order                  */
	int point_count;
	int open_point;            /* unwatched: the last one of the unit, whose words are being
				    * counted; watched: the next one; -1: none  */

	/* free scratch slots, used again by the next statement; each called POU has its own,
	 * so that it does not overwrite its caller's */
	struct slots *slots, program_slots;
	int scratch_used;
	uint32_t sink[IEC_TYPE_COUNT];
};

/* The current result after a line of a list. */
struct result {
	uint32_t line;              /* of the file; of a generated list: number of the instruction */
	bool kept;                  /* it is the result before it             */
	enum iec_type type;         /* IEC_NONE: no single value              */
	uint32_t ran, at;           /* offsets: a BOOL; the value             */
};
#define SLOT_NONE 0    /* no line of a list                                      */
#define SLOT_FREE (-1) /* a line without a result yet                            */
#define RESULT_TEXT 40u /* bytes that are kept of a STRING, for people to read */

/* A safe point: before this line of a unit; its word in CODE_TEXT, words up to the next one.
 * The watched section has the same ones. */
struct point { int unit; uint32_t rung, line, at, words; bool loop; };
#define POINT_APART 64u /* words of code from one to the next, at least         */

struct text_key { const char *text; size_t len; uint32_t offset; };
/* Where the variables of a POU lie while it runs, and their initial values. */
struct frame {
	uint32_t offset, size;      /* of a function or block; size 0: neither */
	uint32_t model;             /* a function's, as it is before a call    */
	uint32_t temps, temps_model, temps_size; /* its VAR_TEMP; size 0: none */
	uint32_t power, power_size; /* of its cells or lines, and of instances inside */
	int power_run;              /* the first run of that                  */
	struct result *result;      /* of written lists; only while watched   */
	int result_count;
	struct result *listed;      /* of its generated list; only while listing */
	int listed_count;
	bool always;                /* all lines run whenever the first one does */
	int *slot_of;               /* by line from first_line on: SLOT_NONE, SLOT_FREE, or
				     * 1 + its index in result                */
	uint32_t first_line, lines;
	bool eno;                   /* does the body name its ENO?              */
	struct slots slots;
};

struct constant_key { enum iec_type type; int64_t bits; uint32_t offset; };

/* ---- layout.c ---- */
/** layout_make - a place for every variable, bit and instance in use. */
bool layout_make(struct assembler *as);
/** layout_place - a place of @size bytes behind all others, as part of a run. */
uint32_t layout_place(struct assembler *as, struct code_run want, uint32_t size,
		      uint32_t align);
/** layout_init_text - a text's first bytes at an offset. */
void layout_init_text(struct assembler *as, uint32_t offset, uint32_t capacity,
		      struct literal literal);
/** layout_like - a place for a copy of an array or structure. */
uint32_t layout_like(struct assembler *as, const struct meaning *m);
/** layout_core - everything placed so far belongs to the running part; watching comes after
 * it. */
void layout_core(struct assembler *as);
/** layout_power - places for the power of cells and the results of lines, and for a copy an
 * instance. */
void layout_power(struct assembler *as);
/** layout_pointers - the initial values of pointers, when all variables have their places. Fails:
 * false: no memory. */
bool layout_pointers(struct assembler *as);
/** layout_spot - where the value of @meaning lies; not for literals. */
struct spot layout_spot(struct assembler *as, const struct meaning *m);
/** layout_constant - a constant's place, made once a value. */
uint32_t layout_constant(struct assembler *as, enum iec_type type,
			 union iec_value value);
/** layout_text - a constant text's place, made once a text. */
uint32_t layout_text(struct assembler *as, const struct literal *literal);
/** layout_tail - a new place behind all others; for scratch and sinks. */
uint32_t layout_tail(struct assembler *as, enum code_run_kind kind,
		     enum iec_type type);
/** layout_init - an initial value at an offset. */
void layout_init(struct assembler *as, uint32_t offset, enum iec_type type,
		 union iec_value value);
/** layout_init_over - the same over an earlier value, so that a 0 is stored too. */
void layout_init_over(struct assembler *as, uint32_t offset, enum iec_type type,
		      union iec_value value);
/** layout_init_pins - the values that a row of the catalogue gives its inputs, in an
 * instance at an offset. */
void layout_init_pins(struct assembler *as, uint32_t offset,
		      const struct word_row *row);
/** layout_init_array - the initial values of an array at an offset. */
void layout_init_array(struct assembler *as, uint32_t offset,
		       const struct var *var);
/** layout_init_parts - initial values of a structure's or instance's declaration, over those of
 * its type. */
void layout_init_parts(struct assembler *as, uint32_t offset,
		       const struct var *var);
/** layout_only_stored - is this pin used only as a parameter of one call? Then a constant can
 * be its initial value, if that call runs in every scan. */
bool layout_only_stored(const struct assembler *as, const struct meaning *pin);
/** layout_pou - the frame of a function or block; @index: of its POU. */
const struct frame *layout_pou(const struct assembler *as, enum word word,
			       uint32_t *index);
/** layout_vars - declared variables of table 0 (globals) or unit + 1. */
const struct var_table *layout_vars(const struct assembler *as, int table);
/** layout_table - index of the table a meaning belongs to. */
int layout_table(const struct assembler *as, const struct meaning *m);

/* ---- fuse.c ---- */
struct bits bits_constant(bool value);
struct bits bits_leaf(const struct assembler *as, uint32_t offset);
struct bits bits_not(struct bits a);
bool bits_is_leaf(const struct bits *a);
bool bits_reads(const struct bits *a, uint32_t offset, uint32_t size);
/** bits_combine - @table2: truth table of (a, b) in bits 0 … 3, index a + 2b.
 * Stores a part first when there are more than three leaves. */
struct bits bits_combine(struct assembler *as, struct bits a, struct bits b,
			 uint8_t table2);
/** bits_store - the instruction that stores @a at @offset. */
void bits_store(struct assembler *as, const struct bits *a, uint32_t offset);
/** bits_end - the next instruction is also reached by a jump: it is not fused. */
void bits_end(struct assembler *as);
/** bits_compare - a comparison, which is @table of its order, in a scratch slot. */
struct bits bits_compare(struct assembler *as, uint32_t table, uint32_t left,
			 uint32_t right);
/** bits_made - the scratch slot of the bit that the instruction at the end of the code makes: a
 * comparison, or ENO of a function. 0: it makes none. */
uint32_t bits_made(const struct assembler *as);
/** bits_store_made - as bits_store(): that instruction stores @a itself, and not its slot.
 * False: @a is another value. A comparison may take one other bit with it. */
bool bits_store_made(struct assembler *as, const struct bits *a, uint32_t offset);
/** bits_keep - @a stored in a scratch slot, as a leaf. */
struct bits bits_keep(struct assembler *as, const struct bits *a);
/** emit - one word of code. */
void emit(struct assembler *as, uint32_t word);
void emit_op(struct assembler *as, enum vm_op op, uint32_t n);
/** emit_block - @size bytes from @from to @to, unless they are the same. */
void emit_block(struct assembler *as, uint32_t to, uint32_t from, uint32_t size);
/** likely_note - an instruction with @en tells at @made whether it succeeded: hardly ever not, if it hardly
 * ever lacks @en. likely_is - was that found out of @en? */
void likely_note(struct assembler *as, uint32_t en, uint32_t made);
bool likely_is(const struct assembler *as, uint32_t en);
uint32_t scratch_new(struct assembler *as);

/* ---- pack_tasks.c ---- */
/** pack_tasks - tasks and what they call; a task's name is its string id. */
bool pack_tasks(struct assembler *as);

/* ---- pack_image.c ---- */
void *pack_image(struct assembler *as, size_t *len);

/** words_push - appends a word. */
void words_push(struct assembler *as, struct words *words, uint32_t word);
#endif
