/* SPDX-License-Identifier: MIT
 *
 * test_pairs - the instructions for two numbers of one type: on limits of all types
 * they give the bits of the functions; and a fused comparison still has its result for
 * other readers.
 */
#include "tests/unit/rig.h"

#include <float.h>
#include <math.h>
#include <stdarg.h>

#define OLD 77 /* value before the operation                                    */

static const char *const function[] = { "ADD", "SUB", "MUL", "DIV", "MOD" };
static enum fn_status (*const run[])(struct fn_args *) = {
	fn_ADD, fn_SUB, fn_MUL, fn_DIV, fn_MOD,
};
static const char *const relation[] = { ">", ">=", "=", "<=", "<", "<>" };

static char source[8000];

/* There is no MOD of REAL. */
static int functions(bool real)
{
	return real ? 4 : 5;
}

__attribute__((format(printf, 1, 2)))
static void say(const char *form, ...)
{
	size_t len = strlen(source);
	va_list args;

	va_start(args, form);
	vsnprintf(source + len, sizeof(source) - len, form, args);
	va_end(args);
}

/* C, E: while On; D, F: always; L: by lines of a list; R: compared; S: and On; P: or On; N: not,
 * and On. */
static const char *program(const char *type)
{
	const int count = functions(strcmp(type, "REAL") == 0);

	source[0] = '\0';
	say("VAR\n  On : BOOL;\n  A, B : %s;\n", type);
	for (int i = 0; i < count; i++)
		say("  C%d, D%d, L%d : %s;\n  E%d, F%d : BOOL;\n", i, i, i, type, i, i);
	for (int i = 0; i < 6; i++)
		say("  R%d, S%d, P%d, N%d : BOOL;\n", i, i, i, i);
	say("END_VAR\nPROGRAM Main LD\n");
	for (int i = 0; i < count; i++) {
		say("RUNG\n  | NO On | %s IN1:=A IN2:=B OUT=>C%d | COIL E%d |\n",
		    function[i], i, i);
		say("RUNG\n  | %s IN1:=A IN2:=B OUT=>D%d | COIL F%d |\n", function[i],
		    i, i);
	}
	for (int i = 0; i < 6; i++) {
		say("RUNG\n  | [ A %s B ] | COIL R%d |\n", relation[i], i);
		say("RUNG\n  | [ A %s B ] | NO On | COIL S%d |\n", relation[i], i);
		say("RUNG\n  | [ A %s B ] | COIL P%d |\n  | NO On ^|\n", relation[i],
		    i);
		say("RUNG\n  | NO On | [ A %s B ] | NOT | COIL N%d |\n", relation[i],
		    i);
	}
	say("END_PROGRAM\nPROGRAM Lines IL\n");
	for (int i = 0; i < count; i++)
		say("  LD A\n  %s B\n  ST L%d\n", function[i], i);
	say("END_PROGRAM\n");
	return source;
}

static int64_t get(struct rig *rig, char letter, int i)
{
	char name[3] = { letter, (char)('0' + i) };

	return rig_get(rig, name);
}

static union iec_value value(struct rig *rig, char letter, int i)
{
	char name[3] = { letter, (char)('0' + i) };

	return image_get(&rig->resource.image, rig_at(rig, name));
}

static void set(struct rig *rig, const char *name, union iec_value to)
{
	image_set(&rig->resource.image, rig_at(rig, name), to);
}

/* The result of the function for the same two values; true: ENO. */
static bool expect(enum iec_type type, int i, const union iec_value in[2],
		   union iec_value *out)
{
	struct fn_args args = { .type = type, .result = type, .count = 2,
				.in = { in[0], in[1] } };
	enum fn_status status = run[i](&args);

	*out = args.out;
	if (status == FN_FAILED)
		*out = type == IEC_REAL ? (union iec_value){ .r = OLD } :
					  (union iec_value){ .i = OLD };
	return status == FN_OK;
}

static bool is_same(enum iec_type type, union iec_value a, union iec_value b)
{
	float left = (float)a.r, right = (float)b.r;

	return type == IEC_REAL ? memcmp(&left, &right, sizeof(left)) == 0 : a.i == b.i;
}

/* Is it what was there before? No function of the values of this test gives that. */
static bool no_result(enum iec_type type, union iec_value out)
{
	return type == IEC_REAL ? out.r == OLD : out.i == OLD;
}

static bool compare(enum iec_type type, int i, const union iec_value in[2])
{
	bool real = type == IEC_REAL;
	bool above = real ? in[0].r > in[1].r : in[0].i > in[1].i;
	bool below = real ? in[0].r < in[1].r : in[0].i < in[1].i;
	bool equal = real ? in[0].r == in[1].r : in[0].i == in[1].i;
	const bool is[] = { above, above || equal, equal, below || equal, below, !equal };

	return is[i];
}

/* One scan on two values; false: a result is wrong. */
static bool agrees(struct rig *rig, enum iec_type type, const union iec_value in[2],
		   bool en)
{
	union iec_value old = { .i = OLD }, out;
	const int count = functions(type == IEC_REAL);
	uint32_t errors = rig->resource.vm.errors;
	bool good = true;

	if (type == IEC_REAL)
		old.r = OLD;
	set(rig, "A", in[0]);
	set(rig, "B", in[1]);
	rig_set(rig, "On", en);
	for (int i = 0; i < count; i++) {
		set(rig, (char[]){ 'C', (char)('0' + i), 0 }, old);
		set(rig, (char[]){ 'D', (char)('0' + i), 0 }, old);
	}
	good &= rig_scan(rig);
	for (int i = 0; i < count; i++) {
		bool eno = expect(type, i, in, &out);

		errors += eno ? 0 : 2u + en;
		good &= get(rig, 'F', i) == eno && get(rig, 'E', i) == (eno && en);
		good &= is_same(type, value(rig, 'D', i), out);
		good &= is_same(type, value(rig, 'C', i), en ? out : old);
		good &= is_same(type, value(rig, 'L', i), no_result(type, out) ? in[0] : out);
	}
	for (int i = 0; i < 6; i++) {
		bool is = compare(type, i, in);

		good &= get(rig, 'R', i) == is && get(rig, 'S', i) == (is && en) &&
			get(rig, 'P', i) == (is || en) && get(rig, 'N', i) == !(is && en);
	}
	return good && rig->resource.vm.errors == errors;
}

static void runs_all(enum iec_type type, bool watch, const union iec_value *in,
		     int count)
{
	const char *name = iec_type_row(type)->word;
	struct rig rig;

	if (rig_open(&rig, program(name), watch)) {
		for (int i = 0; i < count * count * 2; i++) {
			union iec_value pair[2] = { in[i / 2 / count],
						    in[i / 2 % count] };

			if (!agrees(&rig, type, pair, i & 1))
				CHECK_AS(false, name);
		}
		CHECK_AS(rig.resource.vm.errors > 10, name);
	}
	rig_close(&rig);
}

/* ---- boxes one behind the other ---- */

/* G: the first box; H: the second one, which runs if the first one has a result, and whose ENO is K. */
static const char *rows(void)
{
	const int count = functions(true);

	source[0] = '\0';
	say("VAR\n  On : BOOL;\n  A, B : REAL;\n");
	for (int i = 0; i < count * count; i++)
		say("  G%c, H%c : REAL;\n  K%c : BOOL;\n", 'a' + i, 'a' + i, 'a' + i);
	say("END_VAR\nPROGRAM Main LD\n");
	for (int i = 0; i < count * count; i++)
		say("RUNG\n  | NO On | %s IN1:=A IN2:=B OUT=>G%c | %s IN1:=%s IN2:=%s OUT=>H%c | COIL K%c |\n",
		    function[i / count], 'a' + i, function[i % count], i & 1 ? "B" : (char[]){ 'G', (char)('a' + i), 0 },
		    i & 1 ? (char[]){ 'G', (char)('a' + i), 0 } : "B", 'a' + i, 'a' + i);
	say("END_PROGRAM\n");
	return source;
}

static bool row_agrees(struct rig *rig, int i, const union iec_value in[2], bool en, uint32_t *errors)
{
	const int count = functions(true), letter = 'a' - '0' + i;
	union iec_value first, second = { .r = OLD }, pair[2];
	const bool good = expect(IEC_REAL, i / count, in, &first);
	bool both = false;

	if (good && en) {
		pair[i & 1] = first;
		pair[!(i & 1)] = in[1];
		both = expect(IEC_REAL, i % count, pair, &second);
	}
	*errors += en && !both;
	return get(rig, 'K', letter) == both && is_same(IEC_REAL, value(rig, 'H', letter), second) &&
	       is_same(IEC_REAL, value(rig, 'G', letter), en && good ? first : (union iec_value){ .r = OLD });
}

static void runs_rows(bool watch, const union iec_value *in, int count)
{
	const int boxes = functions(true) * functions(true);
	struct rig rig;

	if (!rig_open(&rig, rows(), watch))
		return;
	for (int k = 0; k < count * count * 2; k++) {
		const union iec_value pair[2] = { in[k / 2 / count], in[k / 2 % count] };
		uint32_t errors = rig.resource.vm.errors;
		bool good = true;

		set(&rig, "A", pair[0]);
		set(&rig, "B", pair[1]);
		rig_set(&rig, "On", k & 1);
		for (int i = 0; i < boxes; i++) {
			set(&rig, (char[]){ 'G', (char)('a' + i), 0 }, (union iec_value){ .r = OLD });
			set(&rig, (char[]){ 'H', (char)('a' + i), 0 }, (union iec_value){ .r = OLD });
		}
		good &= rig_scan(&rig);
		for (int i = 0; i < boxes; i++)
			good &= row_agrees(&rig, i, pair, k & 1, &errors);
		if (!good || rig.resource.vm.errors != errors)
			CHECK_AS(false, "two boxes, one behind the other");
	}
	CHECK_AS(rig.resource.vm.errors > 10, "some of a row have no result");
	rig_close(&rig);
}

/* How many of the program's instructions are this one. */
static int count_of(struct rig *rig, enum vm_op op)
{
	const struct program *p = ladder_program(rig->ladder);
	int count = 0;

	for (uint32_t at = 0; at < p->text_words; at += code_words(p->text + at))
		count += (p->text[at] & 0xff) == op;
	return count;
}

/* Each box is one instruction, and so is each comparison with the contacts beside it. */
static void is_short(const char *type, enum vm_op math, enum vm_op cmp)
{
	const int count = functions(math == VM_REAL);
	struct rig rig;

	if (rig_open(&rig, program(type), false)) {
		CHECK(count_of(&rig, math) == 3 * count);
		CHECK_AS(count_of(&rig, VM_COPY) == 0, "a list copies no operand and no result");
		CHECK(count_of(&rig, cmp) == 24);
		CHECK(count_of(&rig, VM_CMP) == 0 && count_of(&rig, VM_FN) == 0);
	}
	rig_close(&rig);
}

/* ---- comparisons read by other instructions ---- */

static void keeps_comparisons(void)
{
	struct rig rig;

	if (!rig_open(&rig,
		"VAR\n  A, B, C : INT;\n  On, X, Y, Z, U, V, W, E : BOOL;\nEND_VAR\n"
		"PROGRAM Main IL\n"
		"  LD A\n  GT B\n  ST X\n  AND On\n  ST Y\n"
		"  LD A\n  GT B\n  STN Z\n  AND On\n  ST U\n"
		"  LD On\n  AND( A\n  GT B\n  )\n  ST V\n"
		"  LD A\n  GT B\n  OR( A\n  EQ B\n  )\n  ST W\n"
		"  LD A\n  GT B\n  S E\n  ANDN On\n  R E\n"
		"END_PROGRAM\n", false))
		return;
	for (int i = 0; i < 2 * 9; i++) {
		int64_t a = i / 6, b = i / 2 % 3, en = i & 1;

		rig_set(&rig, "A", a);
		rig_set(&rig, "B", b);
		rig_set(&rig, "On", en);
		rig_set(&rig, "E", i % 4 > 1);
		rig_scan(&rig);
		CHECK(rig_get(&rig, "X") == (a > b));
		CHECK(rig_get(&rig, "Y") == (a > b && en));
		CHECK(rig_get(&rig, "Z") == !(a > b));
		CHECK(rig_get(&rig, "U") == (a > b && en));
		CHECK(rig_get(&rig, "V") == (a > b && en));
		CHECK(rig_get(&rig, "W") == (a >= b));
		CHECK(rig_get(&rig, "E") == (a > b ? en : i % 4 > 1));
	}
	rig_close(&rig);
}

/* Two coils behind one comparison, and a comparison and a contact that enable a box. */
static void keeps_branches(void)
{
	struct rig rig;

	if (!rig_open(&rig,
		"VAR\n  A, B : INT;\n  On, X, Y, Z : BOOL;\nEND_VAR\nPROGRAM Main LD\n"
		"RUNG\n  | [ A < B ] | NO On | COIL X |\n  |           ^| NC On | COIL Y |\n"
		"RUNG\n  | NO On | [ A < B ] | MOVE IN:=A OUT=>B | COIL Z |\n"
		"END_PROGRAM\n", false))
		return;
	for (int i = 0; i < 4; i++) {
		bool en = i & 1, less = i & 2;

		rig_set(&rig, "A", 5);
		rig_set(&rig, "B", less ? 6 : 4);
		rig_set(&rig, "On", en);
		rig_scan(&rig);
		CHECK(rig_get(&rig, "X") == (less && en));
		CHECK(rig_get(&rig, "Y") == (less && !en));
		CHECK(rig_get(&rig, "Z") == (less && en));
		CHECK(rig_get(&rig, "B") == (less && en ? 5 : less ? 6 : 4));
	}
	rig_close(&rig);
}

/* ---- as text ---- */

static bool prints(const uint32_t *code, const char *want)
{
	char text[200];

	code_print(code, 0, text, sizeof(text));
	if (strcmp(text, want) != 0)
		printf("# %s\n", text);
	return strcmp(text, want) == 0;
}

static void prints_pairs(void)
{
	CHECK(prints((uint32_t[]){ VM_LUT | 1 << 8, 1, 2, 3, 9 << 8 | 0xe8 },
		     "lut     e8 b1 b2 b3 -> b9"));
	CHECK(prints((uint32_t[]){ VM_REAL | MATH_SUB << 8, 1, 2, 4, 8, 12 },
		     "real    SUB en b1 REAL@8 REAL@12 -> REAL@4 eno b2"));
	CHECK(prints((uint32_t[]){ VM_INT | (MATH_DIV | MATH_ENABLED) << 8, 1, 2, 4, 6, 8 },
		     "int     DIV en b1 INT@6 INT@8 -> INT@4 eno b2"));
	CHECK(prints((uint32_t[]){ VM_INT | (MATH_MOD | MATH_LEFT) << 8, 1, 2, 4, 6, 8 },
		     "int     MOD or left en b1 INT@6 INT@8 -> INT@4 eno b2"));
	CHECK(prints((uint32_t[]){ VM_INT | (MATH_MOD | MATH_ENABLED | MATH_LIKELY) << 8, 1, 2, 4, 6, 8 },
		     "int     MOD en b1 INT@6 INT@8 -> INT@4 eno b2"));
	CHECK(prints((uint32_t[]){ VM_AGET | (CODE_KEEP | CODE_SHORT) << 8, 1, 2,
		CODE_OPERAND(IEC_INT, 4), CODE_OPERAND(IEC_INT, 10), CODE_OPERAND(IEC_INT, 8), 1, 5, 2 },
		     "aget    en b1 INT@10[INT@8 - 1] of 5 by 2 -> INT@4 or keep ok b2"));
	CHECK(prints((uint32_t[]){ VM_SWITCH | 3 << 8, CODE_OPERAND(IEC_INT, 8), (uint32_t)-1, 20, 31, 20 },
		     "switch  INT@8 - -1 of 3: 20 31 20"));
	CHECK(prints((uint32_t[]){ VM_CMP_DINT | 0x77 << 8, 4, 8, 0, 9 },
		     "cmp     DINT@4 <> DINT@8 -> b9"));
	CHECK(prints((uint32_t[]){ VM_CMP_REAL | 0xa0 << 8, 4, 8, 3, 9 },
		     "cmp     REAL@4 >= REAL@8 and b3 -> b9"));
	CHECK(prints((uint32_t[]){ VM_CMP_INT | 0xf8 << 8, 4, 8, 3, 9 },
		     "cmp     f8 INT@4 INT@8 b3 -> b9"));
	CHECK(prints((uint32_t[]){ VM_CMP | 0x44 << 8, CODE_OPERAND(IEC_INT, 4),
				   CODE_OPERAND(IEC_DINT, 8), 0, 9 },
		     "cmp     INT@4 < DINT@8 -> b9"));
}

#define I(v) { .i = (v) }
#define R(v) { .r = (double)(v) }

int main(void)
{
	static const union iec_value ints[] = {
		I(0), I(1), I(-1), I(2), I(-7), I(181), I(182), I(-182), I(INT16_MAX),
		I(INT16_MIN), I(INT16_MIN + 1), I(16384),
	};
	static const union iec_value dints[] = {
		I(0), I(1), I(-1), I(3), I(-10), I(46340), I(46341), I(-46341),
		I(INT32_MAX), I(INT32_MIN), I(INT32_MIN + 1), I(1 << 30),
	};
	const union iec_value reals[] = {
		R(0.0f), R(-0.0f), R(1.5f), R(-0.1f), R(FLT_MAX), R(-FLT_MAX),
		R(FLT_MIN), R(FLT_MIN / 8), R(16777216.0f), R(0.33333334f),
		R(INFINITY), R(-INFINITY), R(NAN), R(1e30f), R(-1e-30f),
	};

	for (int watch = 0; watch < 2; watch++) {
		runs_all(IEC_INT, watch, ints, (int)(sizeof(ints) / sizeof(ints[0])));
		runs_all(IEC_DINT, watch, dints, (int)(sizeof(dints) / sizeof(dints[0])));
		runs_all(IEC_REAL, watch, reals, (int)(sizeof(reals) / sizeof(reals[0])));
	}
	for (int watch = 0; watch < 2; watch++)
		runs_rows(watch, reals, (int)(sizeof(reals) / sizeof(reals[0])));
	is_short("INT", VM_INT, VM_CMP_INT);
	is_short("DINT", VM_DINT, VM_CMP_DINT);
	is_short("REAL", VM_REAL, VM_CMP_REAL);
	keeps_comparisons();
	keeps_branches();
	prints_pairs();
	return tap_done();
}
