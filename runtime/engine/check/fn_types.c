/* SPDX-License-Identifier: MIT
 *
 * fn_types - which types a function's pins and result take.
 *
 * Both the check of a list and its translation ask here. It reports nothing.
 */
#include "engine/check/check_il.h"

enum iec_type types_join(enum iec_type a, enum iec_type b)
{
	if (a == IEC_NONE || (b != IEC_NONE && iec_can_widen(a, b)))
		return b;
	if (b == IEC_NONE || iec_can_widen(b, a))
		return a;
	for (int type = IEC_NONE + 1; type < IEC_TYPE_COUNT; type++)
		if (iec_can_widen(a, (enum iec_type)type) &&
		    iec_can_widen(b, (enum iec_type)type))
			return (enum iec_type)type;
	return IEC_TYPE_COUNT;
}

/* The default type of an untyped constant. */
static const enum iec_type usual[] = {
	IEC_DINT, IEC_LINT, IEC_ULINT, IEC_REAL, IEC_LREAL, IEC_DWORD, IEC_LWORD,
	IEC_BOOL,
};

enum iec_type fn_own_type(const struct word_pin *pin, const struct literal *literal)
{
	union iec_value value;

	if (literal->type != IEC_NONE)
		return literal->type;
	for (size_t i = 0; i < sizeof(usual) / sizeof(*usual); i++)
		if (iec_type_row(usual[i])->class & pin->classes &&
		    literal_fit(literal, usual[i], &value))
			return usual[i];
	return IEC_NONE;
}

enum iec_type fn_result(const struct word_row *row, enum iec_type common,
			enum iec_type out)
{
	if (word_shares(row))
		return common;
	if (row->result != RESULT_OPEN)
		return row->result;
	if (iec_type_row(out)->class & row->result_classes)
		return out;
	for (size_t i = 0; i < sizeof(usual) / sizeof(*usual); i++)
		if (iec_type_row(usual[i])->class & row->result_classes)
			return usual[i];
	return IEC_DINT;
}

/* IEC 61131-3 table 30: ADD and others on times and dates. */
static const struct {
	enum word word;
	uint16_t left, right;
	enum word runs;
} overload[] = {
	{ FN_ADD, CLASS_TOD, CLASS_TIME, FN_ADD_TOD_TIME },
	{ FN_ADD, CLASS_DT, CLASS_TIME, FN_ADD_DT_TIME },
	{ FN_SUB, CLASS_TOD, CLASS_TIME, FN_SUB_TOD_TIME },
	{ FN_SUB, CLASS_TOD, CLASS_TOD, FN_SUB_TOD_TOD },
	{ FN_SUB, CLASS_DATE, CLASS_DATE, FN_SUB_DATE_DATE },
	{ FN_SUB, CLASS_DT, CLASS_TIME, FN_SUB_DT_TIME },
	{ FN_SUB, CLASS_DT, CLASS_DT, FN_SUB_DT_DT },
	{ FN_MUL, CLASS_TIME, ANY_NUM, FN_MULTIME },
	{ FN_DIV, CLASS_TIME, ANY_NUM, FN_DIVTIME },
};

enum word fn_overload(enum word word, enum iec_type left, enum iec_type right)
{
	uint16_t a = iec_type_row(left)->class;
	uint16_t b = right == IEC_NONE ? ANY_NUM : iec_type_row(right)->class;

	for (size_t i = 0; i < sizeof(overload) / sizeof(*overload); i++)
		if (overload[i].word == word && overload[i].left == a &&
		    overload[i].right & b)
			return overload[i].runs;
	return word;
}

enum iec_type il_stored_type(struct scope *scope, const struct pou *pou,
			     const struct il *il, int at)
{
	const struct meaning *m;
	enum diag_id why;

	while (++at < il->count && il->line[at].kind == IL_COMMENT)
		;
	if (at >= il->count || il->line[at].kind != IL_OP ||
	    il->line[at].op != OP_ST || il->line[at].modifiers)
		return IEC_NONE;
	m = scope_find(scope, pou, il->line[at].operand, &why);
	return m ? m->type : IEC_NONE;
}
