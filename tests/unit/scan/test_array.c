/* SPDX-License-Identifier: MIT
 *
 * test_array - images with AGET and APUT: bounds in names, the verifier, and that no
 * damaged image accesses memory outside its elements.
 */
#include "engine/base/digest.h"
#include "tests/unit/rig.h"
#include "tests/usual.h"

#include <limits.h>

static const char source[] =
	"VAR\n"
	"  Bits  : ARRAY[-2..5] OF BOOL := [TRUE];\n"
	"  Table : ARRAY[1..4] OF INT := [7, 2(8)];\n"
	"  Words AT %MW4 : ARRAY[0..3] OF WORD;\n"
	"  Lamps AT %QX1.3 : ARRAY[0..9] OF BOOL;\n"
	"  Names : ARRAY[0..1] OF STRING[5] := ['ab', 'c'];\n"
	"  Name  : STRING[5];\n"
	"  i     : LINT;\n"
	"  u     : ULINT;\n"
	"  x     : INT;\n  y     : DINT;\n"
	"END_VAR\n"
	"VAR CONSTANT\n  Fixed : ARRAY[0..2] OF DINT := [1, 2, 3];\nEND_VAR\n"
	"PROGRAM Main IL\n"
	"  LD Bits[i]\n  ST Lamps[u]\n"
	"  LD Table[u]\n  ST Table[i]\n  ST x\n"
	"  LD Words[i]\n  ST %MW20[u]\n"
	"  LD Fixed[i]\n  ST y\n"
	"  LD Names[u]\n  ST Name\n"
	"  LD Lamps[i]\n  ST Bits[u]\n"
	"END_PROGRAM\n";

/* Members of elements: the stride is larger than the value. */
static const char members[] =
	"TYPE\n  Part : STRUCT\n    On : BOOL;\n    N : INT := 3;\n"
	"    T : STRING[5] := 'ab';\n    L : ARRAY[1..2] OF DINT;\n  END_STRUCT;\n"
	"END_TYPE\n"
	"FUNCTION_BLOCK Cell LD\nVAR_INPUT\n  Go : BOOL;\nEND_VAR\n"
	"VAR_IN_OUT\n  All : ARRAY[-1..2] OF Part;\nEND_VAR\n"
	"VAR_OUTPUT\n  Q : BOOL;\nEND_VAR\nVAR\n  W : ARRAY[0..1] OF TON;\nEND_VAR\n"
	"RUNG\n  | NO Go | TON W[1] PT:=T#1s | COIL Q |\n"
	"RUNG\n  | [ All[2].N := All[1].N + 1 ] |\nEND_FUNCTION_BLOCK\n"
	"VAR\n"
	"  Z : ARRAY[-1..2] OF Part;\n  C : ARRAY[1..3] OF Cell;\n"
	"  E : ARRAY[1..3] OF R_TRIG;\n  P : Part;\n"
	"  i : LINT;\n  u : ULINT;\n  x : INT;\n  q : STRING[5];\n  b : BOOL;\n"
	"  l : DINT;\n"
	"END_VAR\n"
	"PROGRAM Main IL\n"
	"  LD Z[i].N\n  ST Z[u].N\n  ST x\n"
	"  LD Z[i].On\n  ST Z[u].On\n"
	"  LD Z[u].T\n  ST q\n  LD q\n  ST Z[i].T\n"
	"  LD Z[i].L[2]\n  ST P.L[u]\n  ST l\n"
	"  LD C[i].Q\n  ST C[u].Go\n"
	"  CAL C[2](Go := b, All := Z)\n"
	"  LD Z[0].On\n  ST E[2].CLK\n  CAL E[2]\n  LD E[i].Q\n  ST b\n"
	"  MOVE(IN := Z[1], OUT => Z[0])\n"
	"END_PROGRAM\n";

/* Several indices; elements that are structures. */
static const char grids[] =
	"TYPE\n  Part : STRUCT\n    On : BOOL;\n    N : INT := 3;\n"
	"    T : STRING[5] := 'ab';\n    L : ARRAY[1..2] OF DINT;\n  END_STRUCT;\n"
	"  Line : STRUCT\n    C : ARRAY[-1..2] OF Part;\n    D : DINT;\n  END_STRUCT;\n"
	"END_TYPE\n"
	"VAR\n"
	"  Z : ARRAY[1..3] OF Line;\n  P : Part;\n  Q : ARRAY[1..2] OF DINT;\n"
	"  i : LINT;\n  u : ULINT;\n  x : INT;\n  y : DINT;\n  t : STRING[5];\n  b : BOOL;\n"
	"END_VAR\n"
	"PROGRAM Main IL\n"
	"  LD Z[i].C[u].N\n  ST Z[u].C[i].N\n  ST x\n"
	"  LD Z[u].C[i].L[u]\n  ST Z[i].C[u].L[i]\n  ST y\n"
	"  LD Z[i].C[i].T\n  ST Z[u].C[2].T\n  ST t\n"
	"  LD Z[i].C[i].On\n  ST Z[u].C[2].On\n  ST b\n"
	"  LD Z[i].C[u]\n  ST P\n  ST Z[u].C[i]\n"
	"  LD P\n  ST Z[i].C[i]\n"
	"  LD Z[i].C[u].L\n  ST Q\n"
	"  MOVE(IN := Z[u], OUT => Z[i])\n"
	"  MOVE(IN := Z[2], OUT => Z[i])\n"
	"END_PROGRAM\n";

/* Accesses that the VM has a shorter way for. */
static const char shorts[] =
	"VAR\n"
	"  T : ARRAY[1..4] OF INT := [7, 2(8)];\n  D : ARRAY[-1..2] OF DINT;\n"
	"  R : ARRAY[0..2] OF REAL;\n  L : ARRAY[0..2] OF LINT;\n"
	"  h : INT;\n  w : DINT;\n  s : SINT;\n  x : INT;\n  y : DINT;\n  z : REAL;\n  v : LINT;\n"
	"END_VAR\n"
	"PROGRAM Main ST\n"
	"  x := T[h];\n  T[w] := x;\n  y := D[w];\n  z := R[h];\n"
	"  x := T[s];\n  v := L[h];\n  y := T[h];\n  T[h + x] := T[w];\n"
	"  FOR h := 1 TO 4 DO T[h] := h; END_FOR;\n"
	"  FOR w := 2 TO -1 BY -1 DO D[w] := w; END_FOR;\n"
	"  x := T[h - 1];\n  y := D[2 + w];\n"
	"END_PROGRAM\n";

/* Pointers to values of several kinds. */
static const char pointers[] =
	"VAR\n"
	"  T : ARRAY[1..4] OF INT := [7, 2(8)];\n  S : STRING[8] := 'abc';\n  R : REAL := 1.5;\n"
	"  P : POINTER TO ARRAY[1..4] OF INT;\n  C : POINTER TO BYTE;\n"
	"  W : POINTER TO DWORD;\n  Any : POINTER TO INT;\n"
	"  i : LINT;\n  u : ULINT;\n  x : INT;\n  b : BYTE;\n  d : DWORD;\n"
	"END_VAR\n"
	"PROGRAM Main ST\n"
	"  P := ADR(T);\n  C := ADR(S);\n  W := ADR(R);\n"
	"  x := P^[i];\n  P^[u] := x;\n"
	"  C := C + i;\n  b := C^;\n  C^ := b;\n"
	"  d := W^;\n  W^ := d;\n"
	"  Any^ := 300;\n  x := Any^;\n"
	"END_PROGRAM\n";

static uint8_t *good, *image;
static size_t len;

static struct code_header *header(void)
{
	return (void *)image;
}

static uint32_t *text(void)
{
	return (void *)(image + header()->section[CODE_TEXT].offset);
}

static void seal(void)
{
	size_t covered = offsetof(struct code_header, crc) + 4;

	header()->crc = digest_crc32c(0, image + covered, len - covered);
}

static void set_index(struct image *at, const char *name, int64_t index)
{
	struct location where = image_find(at, name, 1);

	if (where.type == IEC_LINT || where.type == IEC_ULINT)
		image_set(at, where, (union iec_value){ .i = index });
}

/* Reads the memory of every name of the image. */
static void read_members(const struct image *at)
{
	static const struct { const char *head, *tail; } of[] = {
		{ "Z", ".N" }, { "Z", ".T" }, { "Z", ".L[2]" }, { "C", ".Q" },
		{ "E", ".CLK" },
	};
	struct declared_name row;

	for (size_t i = 0; i < sizeof(of) / sizeof(*of); i++)
		if (image_find_members(at, of[i].head, 1, of[i].tail,
				       strlen(of[i].tail), &row))
			for (uint32_t k = 0; k < row.array.count; k++) {
				struct location to = declared_element(&row, k);
				union iec_value value = image_get(at, to);

				if (to.type == IEC_STRING && value.s->length > 5)
					abort();
			}
}

/* If the copy is accepted, runs it for a few scans with indices of all kinds. */
static bool let_in(void)
{
	static const int64_t index[] = { 0, 1, -1, 5, INT64_MAX, INT64_MIN, 100000 };
	struct resource resource;
	struct program program;
	struct arena scratch;
	enum diag_id why;
	size_t where;
	bool open;

	seal();
	arena_init(&scratch);
	open = code_open(image, len, &scratch, &program, &why, &where);
	arena_free(&scratch);
	if (open) {
		void *memory = calloc(1, image_memory_size(&program));

		if (!memory)
			abort();
		resource_init(&resource, &program, memory);
		resource_start(&resource);
		for (size_t i = 0; i < sizeof(index) / sizeof(*index); i++) {
			set_index(&resource.image, "i", index[i]);
			set_index(&resource.image, "u", index[i]);
			resource_scan(&resource, (int64_t)i * RIG_PERIOD);
		}
		read_members(&resource.image);
		free(memory);
	}
	memcpy(image, good, len);
	return open;
}

/* Instruction number @number of this kind; its word and operands. */
static uint32_t *find(enum vm_op op, int number)
{
	uint32_t words = header()->section[CODE_TEXT].size / 4;

	for (uint32_t at = 0; at < words; at += code_words(text() + at))
		if ((text()[at] & 0xff) == op && number-- == 0)
			return text() + at;
	abort();
}

/* Sets one operand (1: en, 2: ok, 3: value, 4: base, 5: index, 6: low, 7: count, 8:
 * stride); true if the image is refused. */
static bool refuses(enum vm_op op, int number, int operand, uint32_t value)
{
	find(op, number)[operand] = value;
	return !let_in();
}

static void test_bounds(void)
{
	static const char *const none[] = {
		"", "Name", "[1..2]", "A[", "A[1]", "A[1..]", "A[..2]", "A[1.2]",
		"A[1..2", "A[1..2]x", "A[2..1]", "A[a..b]", "A[1..2000000000]",
		"A[--1..2]", "A[1..99999999999]", "A[-2147483649..0]", "A[0..1000000]",
	};
	struct code_bounds got;

	for (size_t i = 0; i < sizeof(none) / sizeof(*none); i++) {
		got = code_bounds(none[i]);
		CHECK_AS(got.count == 0 && got.head == strlen(none[i]), none[i]);
	}
	got = code_bounds("A[1..10]");
	CHECK(got.head == 1 && got.low == 1 && got.count == 10);
	got = code_bounds("Long[-2147483648..-2147483647]");
	CHECK(got.head == 4 && got.low == INT32_MIN && got.count == 2);
	got = code_bounds("Most[0..999999]");
	CHECK(got.count == 1000000);
}

static void test_refused(void)
{
	uint32_t *get = find(VM_AGET, 1), *put = find(VM_APUT, 1);
	uint32_t base = get[4], index = get[5], count = get[7];
	const struct areas *areas = usual_areas();

	CHECK_AS(let_in(), "the unchanged image is accepted");
	CHECK(CODE_TYPE(base) == IEC_INT && count == 4 && get[8] == 2);
	CHECK(refuses(VM_AGET, 1, 1, base) && refuses(VM_AGET, 1, 2, CODE_TRUE_AT(areas)));
	CHECK(refuses(VM_AGET, 1, 3, base & 0xffffff) &&
	      refuses(VM_AGET, 1, 3, find(VM_AGET, 3)[4]));
	CHECK_AS(refuses(VM_AGET, 1, 4, CODE_OPERAND(IEC_DINT, CODE_OFFSET(base))),
		 "an element of another type is refused");
	CHECK(refuses(VM_AGET, 1, 4, base + 1));
	CHECK(refuses(VM_AGET, 1, 5, find(VM_AGET, 0)[4]));
	CHECK(refuses(VM_AGET, 1, 5, index + 1));
	CHECK(refuses(VM_AGET, 1, 7, 0) && refuses(VM_AGET, 1, 7, UINT32_MAX));
	CHECK_AS(refuses(VM_AGET, 1, 7, 0x80000001),
		 "a count whose size in bytes overflows is refused");
	CHECK_AS(refuses(VM_AGET, 1, 7, 1000),
		 "a count beyond the end of the array is refused");
	CHECK(refuses(VM_AGET, 1, 8, 0) && refuses(VM_AGET, 1, 8, 1) &&
	      refuses(VM_AGET, 1, 8, 0x55555556) && refuses(VM_AGET, 1, 8, 4000));
	CHECK(refuses(VM_AGET, 1, 0, VM_AGET | 1u << 8));
	CHECK(refuses(VM_AGET, 1, 0, VM_AGET | 2u << 8));
	CHECK_AS(refuses(VM_APUT, 1, 4, find(VM_AGET, 3)[4]),
		 "an APUT into a constant is refused");
	CHECK_AS(refuses(VM_APUT, 1, 4,
			 CODE_OPERAND(IEC_INT, usual_areas()->at[AREA_I])),
		 "an APUT into an input is refused");
	CHECK(CODE_TYPE(put[4]) == IEC_INT && refuses(VM_APUT, 1, 4, areas->size - 2));
	/* Bits of areas: up to the end of the area, not one more. */
	CHECK((find(VM_APUT, 0)[0] >> 8) == 1);
	CHECK(refuses(VM_APUT, 0, 7, usual_areas()->bytes[AREA_Q] * 8));
	CHECK(refuses(VM_APUT, 0, 7, 0) && refuses(VM_APUT, 0, 8, usual_areas()->bytes[AREA_Q] * 8));
	CHECK(refuses(VM_APUT, 0, 4, CODE_OPERAND(IEC_BOOL, areas->size * 8)));
	CHECK(refuses(VM_APUT, 0, 4, CODE_OPERAND(IEC_BOOL, 0)));
	/* Texts: a stride other than their room. */
	CHECK(CODE_TYPE(find(VM_AGET, 4)[4]) == IEC_STRING);
	CHECK(refuses(VM_AGET, 4, 8, 4) && refuses(VM_AGET, 4, 7, 400));
}

static void test_symbols(void)
{
	static const char *const worse[] = { "Table[1..9]", "Names[0..9]", "Fixed[0..9]" };
	char *string = (char *)image + header()->section[CODE_STRINGS].offset;
	size_t size = header()->section[CODE_STRINGS].size;

	for (size_t i = 0; i < 3; i++)
		for (size_t at = 0; at + strlen(worse[i]) < size; at++)
			if (strncmp(string + at, worse[i], 6) == 0) {
				memcpy(string + at, worse[i], strlen(worse[i]));
				/* More elements than the run of values holds. */
				string[at + 9] = '9';
				let_in();
				break;
			}
	CHECK_AS(let_in(), "the image with its names restored is accepted");
}

/* The first access of a kind to elements of @type; its number. */
static int access_of(enum vm_op op, enum iec_type type)
{
	int number = 0;

	while (CODE_TYPE(find(op, number)[4]) != type)
		number++;
	return number;
}

static void test_members(void)
{
	int n = access_of(VM_AGET, IEC_INT), s = access_of(VM_AGET, IEC_STRING);
	int put = access_of(VM_APUT, IEC_STRING);
	const uint32_t *get = find(VM_AGET, n);
	uint32_t base = get[4], stride = get[8];

	CHECK_AS(let_in(), "the unchanged image is accepted");
	CHECK(get[7] == 4 && (int32_t)get[6] == -1 && stride > 16);
	CHECK(refuses(VM_AGET, n, 7, 5) && refuses(VM_AGET, n, 8, stride + 2));
	CHECK(refuses(VM_AGET, n, 8, stride - 8) && refuses(VM_AGET, n, 8, 2));
	CHECK_AS(!refuses(VM_AGET, n, 7, 3),
		 "a count below the length of the array is accepted");
	CHECK(refuses(VM_AGET, n, 4, base + 2) && refuses(VM_AGET, n, 4, base + stride));
	CHECK(refuses(VM_AGET, s, 7, 5) && refuses(VM_AGET, s, 8, 4));
	CHECK(refuses(VM_APUT, put, 4, find(VM_APUT, put)[4] + stride));
}

static void test_grids(void)
{
	int n = access_of(VM_AGET, IEC_DINT);
	const uint32_t *get = find(VM_AGET, n), *block = find(VM_ABLOCK, 0);
	const struct areas *areas = usual_areas();
	uint32_t base = get[4], size = block[5];

	CHECK_AS(let_in(), "the unchanged image is accepted");
	CHECK(get[0] >> 8 == 4 && get[7] == 3 && get[11] == 4 && get[15] == 2 &&
	      get[8] > 4 * get[12] && get[12] > get[16] && get[16] == 4);
	for (int k = 0; k < 3; k++) {
		int index = 5 + 4 * k, count = index + 2, stride = index + 3;

		CHECK(refuses(VM_AGET, n, index, areas->size));
		CHECK(refuses(VM_AGET, n, count, 0) && refuses(VM_AGET, n, count, 5));
		CHECK(refuses(VM_AGET, n, count, UINT32_MAX));
		CHECK(refuses(VM_AGET, n, count, 0x80000001));
		CHECK(refuses(VM_AGET, n, stride, 0) && refuses(VM_AGET, n, stride, 2));
		CHECK(refuses(VM_AGET, n, stride, UINT32_MAX));
		CHECK_AS(!refuses(VM_AGET, n, count, 1),
			 "a count below the length of the array is accepted");
	}
	CHECK(refuses(VM_AGET, n, 4, base + 4) && refuses(VM_AGET, n, 0, VM_AGET | 5u << 8));
	CHECK_AS(refuses(VM_AGET, n, 0, VM_AGET | 18u << 8),
		 "an AGET with too many indices is refused");
	CHECK_AS(refuses(VM_AGET, n, 0, VM_AGET | 0xffffff00u),
		 "an AGET with the highest number of indices is refused");
	/* ABLOCK: the place of the other value, the element, its size. */
	CHECK(block[0] >> 8 == 2 && block[8] == 3 && block[12] == 4);
	CHECK(refuses(VM_ABLOCK, 0, 1, base) && refuses(VM_ABLOCK, 0, 2, CODE_TRUE_AT(areas)));
	CHECK(refuses(VM_ABLOCK, 0, 3, block[3] + 8) && refuses(VM_ABLOCK, 0, 3, block[4]));
	CHECK(refuses(VM_ABLOCK, 0, 3, areas->size) && refuses(VM_ABLOCK, 0, 3, UINT32_MAX));
	CHECK(refuses(VM_ABLOCK, 0, 4, block[4] + 8) && refuses(VM_ABLOCK, 0, 4, 0));
	CHECK(refuses(VM_ABLOCK, 0, 4, UINT32_MAX - 8));
	CHECK(refuses(VM_ABLOCK, 0, 5, 0) && refuses(VM_ABLOCK, 0, 5, size + 8));
	CHECK(refuses(VM_ABLOCK, 0, 5, UINT32_MAX));
	CHECK(refuses(VM_ABLOCK, 0, 8, 4) && refuses(VM_ABLOCK, 0, 9, 8));
	CHECK(refuses(VM_ABLOCK, 0, 12, 5) && refuses(VM_ABLOCK, 0, 13, block[13] + 8));
	CHECK(refuses(VM_ABLOCK, 0, 6, areas->size) && refuses(VM_ABLOCK, 0, 0, VM_ABLOCK | 18u << 8));
}

static uint32_t marks_of(enum vm_op op, int number)
{
	return *find(op, number) >> 8;
}

static bool refuses_marks(enum vm_op op, int number, uint32_t n)
{
	return refuses(op, number, 0, (uint32_t)op | n << 8);
}

static void test_steps(void)
{
	const uint32_t *add = find(VM_INT, 1);
	const uint32_t other = find(VM_DINT, 0)[3];

	CHECK_AS(marks_of(VM_INT, 1) == (MATH_ADD | MATH_LOOP) &&
		 marks_of(VM_DINT, 0) == (MATH_ADD | MATH_LOOP), "a FOR has a step, up or down");
	CHECK((add[6] & 0xff) == VM_CMP_INT && add[6] >> 8 == CODE_AT_MOST && add[11] == VM_JMPC);
	CHECK(find(VM_DINT, 0)[6] >> 8 == 0xaa);
	CHECK_AS(!refuses_marks(VM_INT, 1, MATH_ADD), "no mark is needed");
	CHECK_AS(refuses_marks(VM_INT, 0, MATH_ADD | MATH_LOOP), "without a comparison it is no step");
	CHECK(refuses_marks(VM_INT, 1, MATH_SUB | MATH_LOOP) && refuses_marks(VM_INT, 1, MATH_ADD | MATH_LOOP | MATH_LEFT));
	CHECK(refuses_marks(VM_INT, 1, MATH_ADD | MATH_LOOP | MATH_ENABLED));
	CHECK(refuses(VM_INT, 1, 6, VM_CMP_INT | 0x2au << 8) && refuses(VM_INT, 1, 6, VM_CMP_INT | 0xcau << 8));
	CHECK_AS(!refuses(VM_INT, 1, 6, VM_CMP_INT | 0x22u << 8) && !refuses(VM_INT, 1, 11, VM_JMPC | 1u << 8),
		 "any order will do, and a jump unless it is so");
	CHECK(refuses(VM_INT, 1, 6, VM_CMP_DINT | 0xccu << 8) && refuses(VM_INT, 1, 7, add[8]));
	CHECK(refuses(VM_INT, 1, 3, other) && refuses(VM_INT, 1, 13, add[2]));
	CHECK(refuses(VM_INT, 1, 11, VM_JMPC | 2u << 8) && refuses(VM_INT, 1, 11, VM_JMP));
}

static void test_shorts(void)
{
	enum { HALF = CODE_SHORT, FULL = CODE_SHORT | CODE_LONG, WIDE = CODE_SHORT | CODE_WIDE };

	CHECK_AS(let_in(), "the unchanged image is accepted");
	CHECK(marks_of(VM_AGET, 0) == (HALF | CODE_KEEP) && marks_of(VM_APUT, 0) == WIDE);
	CHECK(marks_of(VM_AGET, 1) == (FULL | CODE_WIDE | CODE_KEEP) &&
	      marks_of(VM_AGET, 2) == (FULL | CODE_KEEP));
	CHECK_AS(marks_of(VM_AGET, 3) == CODE_KEEP && marks_of(VM_AGET, 4) == CODE_KEEP,
		 "a SINT as index and values of 8 bytes have no shorter way");
	CHECK_AS(marks_of(VM_AGET, 5) == HALF, "a value that is widened later is read as it is");
	CHECK(marks_of(VM_AGET, 6) == WIDE && marks_of(VM_APUT, 1) == HALF);
	CHECK_AS(!refuses_marks(VM_AGET, 0, HALF) && !refuses_marks(VM_AGET, 0, CODE_KEEP) &&
		 !refuses_marks(VM_APUT, 0, 0), "no mark is needed");
	CHECK_AS(refuses_marks(VM_AGET, 0, WIDE) && refuses_marks(VM_APUT, 0, HALF),
		 "an index has the type that is said");
	CHECK_AS(refuses_marks(VM_AGET, 0, FULL) && refuses_marks(VM_AGET, 1, WIDE) &&
		 refuses_marks(VM_AGET, 4, FULL) && refuses_marks(VM_AGET, 4, HALF),
		 "values have the size that is said");
	CHECK(refuses_marks(VM_AGET, 0, CODE_LONG) && refuses_marks(VM_AGET, 0, CODE_WIDE));
	CHECK(refuses_marks(VM_AGET, 3, HALF));
	CHECK(refuses_marks(VM_AGET, 0, HALF | 1) && refuses_marks(VM_AGET, 0, HALF | 2));
	CHECK_AS(refuses_marks(VM_APUT, 0, WIDE | CODE_KEEP), "only AGET keeps a value");
	CHECK(refuses_marks(VM_AGET, 0, HALF | 512) && refuses_marks(VM_APUT, 1, 1u << 23));
	CHECK_AS(refuses(VM_AGET, 0, 3, find(VM_AGET, 1)[3]), "both values have one type");
	CHECK_AS(find(VM_AGET, 7)[5] == find(VM_AGET, 0)[5] && find(VM_AGET, 7)[6] == 2 &&
		 find(VM_AGET, 8)[5] == find(VM_AGET, 1)[5] && (int32_t)find(VM_AGET, 8)[6] == -3,
		 "a constant that is added to an index goes into its bounds");
	CHECK_AS(marks_of(VM_AGET, 7) == (HALF | CODE_KEEP), "it has the shorter way");
	CHECK(refuses(VM_AGET, 7, 7, 5000) && refuses(VM_AGET, 7, 4, find(VM_AGET, 7)[4] + 1));
	CHECK_AS(!refuses(VM_AGET, 7, 6, 0x80000000), "any first index is as good");
	test_steps();
}

static void test_pointers(void)
{
	const uint32_t *peek = find(VM_PEEK, 0), *poke = find(VM_POKE, 0);
	const uint32_t pointer = CODE_OFFSET(peek[4]);

	CHECK_AS(let_in(), "the unchanged image is accepted");
	CHECK(CODE_TYPE(peek[4]) == IEC_INT && CODE_TYPE(poke[4]) == IEC_INT);
	CHECK(refuses(VM_PEEK, 0, 1, pointer) && refuses(VM_PEEK, 0, 2, CODE_TRUE_AT(usual_areas())));
	CHECK_AS(refuses(VM_PEEK, 0, 4, CODE_OPERAND(IEC_STRING, pointer)),
		 "a pointer leads to no whole text");
	CHECK(refuses(VM_PEEK, 0, 4, CODE_OPERAND(IEC_INT, pointer + 2)) &&
	      refuses(VM_PEEK, 0, 4, CODE_OPERAND(IEC_INT, 0xfffff8)));
	CHECK(refuses(VM_PEEK, 0, 6, CODE_OPERAND(IEC_REAL, CODE_OFFSET(peek[6]))) &&
	      refuses(VM_PEEK, 0, 3, CODE_OPERAND(IEC_STRING, CODE_OFFSET(peek[3]))));
	CHECK_AS(refuses(VM_POKE, 0, 4, CODE_OPERAND(IEC_DINT, CODE_OFFSET(poke[4]))),
		 "a value of another type is refused");
}

static int64_t value_of(struct rig *rig, const char *name)
{
	return image_get(&rig->resource.image,
			 image_find(&rig->resource.image, name, strlen(name))).i;
}

/* Names with members, and ranges of them as in scenarios. */
static void test_member_names(void)
{
	static const char *const none[] = {
		"Z", "Z[0]", "Z[0].", "Z[3].N", "Z[0].X", "Z[].N", "Z.N", "Z[0].L",
		"Z[0].L[3]", "C[1].W[1].Q.X", "E[1]", "E[4].Q", "Z[0]N",
	};
	struct declared_name row;
	struct rig rig;

	if (!rig_open(&rig, members, false))
		return;
	for (size_t i = 0; i < sizeof(none) / sizeof(*none); i++)
		CHECK_AS(image_find(&rig.resource.image, none[i],
				    strlen(none[i])).type == IEC_NONE, none[i]);
	CHECK(value_of(&rig, "Z[2].N") == 3 && value_of(&rig, "z[-1].n") == 3);
	CHECK(value_of(&rig, "Z[0].L[2]") == 0 && value_of(&rig, "E[3].Q") == 0);
	CHECK(image_find_members(&rig.resource.image, "Z", 1, ".N", 2, &row) &&
	      row.array.low == -1 && row.array.count == 4 && row.at.type == IEC_INT);
	CHECK(image_find_members(&rig.resource.image, "E", 1, ".Q", 2, &row) &&
	      row.array.low == 1 && row.array.count == 3 && row.stride == 8);
	CHECK(!image_find_members(&rig.resource.image, "P", 1, ".N", 2, &row));
	CHECK(!image_find_members(&rig.resource.image, "Z", 1, ".X", 2, &row));
	rig_close(&rig);
}

/* Whatever a pointer says, constants and addresses stay, and every text fits its room. */
static void test_any_pointer(void)
{
	struct rig rig;
	uint64_t seed = 1;
	uint8_t *memory;

	if (!rig_open(&rig, pointers, false))
		return;
	memory = rig.memory;
	for (int round = 0; round < 20000; round++) {
		const struct location any = image_find(&rig.resource.image, "Any", 3);

		seed = seed * 6364136223846793005u + 1442695040888963407u;
		const uint64_t place = usual_areas()->size - 16 + seed / 65536 % 400;

		image_set(&rig.resource.image, any, (union iec_value){
			.i = (int64_t)(place << 40 | (seed >> 40 & 63) << 20 | (seed >> 48 & 15)) });
		rig_scan(&rig);
		if (memory[CODE_FALSE_AT(usual_areas())] != 0 || memory[CODE_TRUE_AT(usual_areas())] != 1)
			break;
	}
	CHECK(memory[CODE_FALSE_AT(usual_areas())] == 0 && memory[CODE_TRUE_AT(usual_areas())] == 1);
	rig_close(&rig);
}

/* Each byte changed in turn (in an emulator each tenth), with a correct checksum: the image is refused, or runs
 * without harm. */
static void test_every_byte(void)
{
	static const uint8_t flip[] = { 0x01, 0x80, 0xff };
	const size_t step = 10 / (size_t)tap_rounds(10);
	int refused = 0;

	for (size_t at = sizeof(struct code_header); at < len; at += step)
		for (int k = 0; k < 3; k++) {
			image[at] ^= flip[k];
			refused += !let_in();
		}
	CHECK(refused > 0);
}

/* Loading must stay fast: many accesses to one large array, and an image with more
 * single steps than allowed. */
static void test_effort(void)
{
	static char program[64 * 1024];
	struct rig rig;
	size_t used = (size_t)snprintf(program, sizeof(program),
		"VAR\n  Big : ARRAY[0..999999] OF BOOL;\n  i : DINT;\nEND_VAR\n"
		"PROGRAM Main IL\n");

	for (int k = 0; k < 100; k++)
		used += (size_t)snprintf(program + used, sizeof(program) - used,
					 "  LD Big[i]\n  ST Big[i]\n");
	snprintf(program + used, sizeof(program) - used, "END_PROGRAM\n");
	if (rig_open(&rig, program, false))
		CHECK(ladder_program(rig.ladder)->symbol_count == 2);
	rig_close(&rig);
}

static void test_names(void)
{
	static const char *const none[] = {
		"Table", "Table[0]", "Table[5]", "Table[", "Table[1", "Table[]", "Table[-]",
		"Table[1]]", "Table[x]", "Table[99999999999999]", "Table[1].Q", "i[1]",
		"Table[1..4]", "Table[4294967297]",
	};
	struct symbol_cursor cursor = { 0 };
	struct symbol symbol;
	struct rig rig;
	int count = 0;

	if (!rig_open(&rig, source, false))
		return;
	for (size_t i = 0; i < sizeof(none) / sizeof(*none); i++)
		CHECK_AS(image_find(&rig.resource.image, none[i],
				    strlen(none[i])).type == IEC_NONE, none[i]);
	CHECK(value_of(&rig, "Table[1]") == 7 && value_of(&rig, "table[3]") == 8);
	CHECK(value_of(&rig, "table[ 3 ]") == 8 && value_of(&rig, "Bits[-2]") == 1);
	CHECK(value_of(&rig, "Fixed[2]") == 3 && value_of(&rig, "Table[4]") == 0);
	while (image_next_symbol(&rig.resource.image, &cursor, &symbol)) {
		struct location at = image_find(&rig.resource.image, symbol.name,
						strlen(symbol.name));

		count++;
		CHECK_AS(at.type == symbol.at.type && at.where == symbol.at.where &&
			 at.area == symbol.at.area, symbol.name);
	}
	CHECK(count == 8 + 4 + 4 + 10 + 2 + 5 + 3);
	rig_close(&rig);
}

/* The tests of one image; each works on a copy. */
static void test_image(const char *text, void (*refused)(void))
{
	struct rig rig;
	const void *bytes;

	if (!rig_open(&rig, text, true))
		return;
	bytes = ladder_image(rig.ladder, &len);
	good = aligned_alloc(8, (len + 7) / 8 * 8);
	image = aligned_alloc(8, (len + 7) / 8 * 8);
	if (!good || !image)
		abort();
	memcpy(good, bytes, len);
	memcpy(image, bytes, len);
	refused();
	test_every_byte();
	free(good);
	free(image);
	rig_close(&rig);
}

static void test_values(void)
{
	test_refused();
	test_symbols();
}

int main(void)
{
	test_bounds();
	test_names();
	test_member_names();
	test_effort();
	test_image(source, test_values);
	test_image(members, test_members);
	test_image(grids, test_grids);
	test_image(shorts, test_shorts);
	test_image(pointers, test_pointers);
	test_any_pointer();
	return tap_done();
}
