# SPDX-License-Identifier: MIT
#
# PlcopenShape - is a text PLCopen XML of version 2.01? Which elements stand in which, in which order, and which
# attributes they must and may have: the facts of the schema of TC6, version 2.01 (http://www.plcopen.org/xml/tc6_0201),
# as tables of this project. Also what a schema does not say of our files: each localId stands once in its body,
# each connection leads to an element of its body, and a named pin is an output of it.
package PlcopenShape;
use strict;
use warnings;

# Of a kind: its children as a regular expression over their names, then its attributes; those with ! must be there.
# A child that is written name:kind has another kind than its name.
my $end = 'addData? documentation:text?';
my $list = "(variable:declared)* $end | name constant retain nonretain persistent nonpersistent";
my $drawn = 'height width executionOrderId globalId';
my $modified = 'negated edge storage';
my $fbd = 'comment error connector continuation actionBlock vendorElement block inVariable outVariable inOutVariable label jump return';
my $ld = "$fbd leftPowerRail rightPowerRail coil contact";
my $sfc = "$ld step macroStep jumpStep transition selectionDivergence selectionConvergence simultaneousDivergence simultaneousConvergence";
my @elementary = qw(BOOL BYTE WORD DWORD LWORD SINT INT DINT LINT USINT UINT UDINT ULINT REAL LREAL TIME DATE DT TOD
	ANY ANY_DERIVED ANY_ELEMENTARY ANY_MAGNITUDE ANY_NUM ANY_REAL ANY_INT ANY_BIT ANY_STRING ANY_DATE);
my $type = '(' . join('|', @elementary, qw(string wstring array derived enum struct subrangeSigned subrangeUnsigned pointer)) . ')';
sub any { return '(' . join('|', split ' ', $_[0]) . ')*' }

my %kinds = (
	project => 'fileHeader contentHeader types instances addData? documentation:text? |',
	fileHeader => '| companyName! companyURL productName! productVersion! productRelease creationDateTime! contentDescription',
	contentHeader => 'Comment:characters? coordinateInfo addDataInfo? addData? | name! version modificationDateTime organization author language',
	coordinateInfo => 'pageSize:point? fbd:scaled ld:scaled sfc:scaled |',
	scaled => 'scaling:point |',
	point => '| x! y!',
	types => 'dataTypes pous |',
	dataTypes => '(dataType)* |',
	dataType => "baseType:type initialValue:value? $end | name!",
	pous => '(pou)* |',
	pou => "interface? actions? transitions? (body)* $end | name! pouType! globalId",
	interface => 'returnType:type? ' . '(' . join('|', map { "$_:variables" } qw(localVars tempVars inputVars outputVars inOutVars externalVars globalVars accessVars)) . ")* $end |",
	variables => $list,
	declared => "type initialValue:value? $end | name! address globalId",
	actions => '(action:named)* |',
	transitions => '(transition:named)* |',
	named => "body $end | name! globalId",
	body => "(IL:text|ST:text|FBD|LD|SFC) $end | WorksheetName globalId",
	FBD => any($fbd) . ' |', LD => any($ld) . ' |', SFC => any($sfc) . ' |',
	instances => 'configurations |',
	configurations => '(configuration)* |',
	configuration => "(resource)* (globalVars:variables)* accessVars? configVars? $end | name! globalId",
	resource => "(task)* (globalVars:variables)* (pouInstance)* $end | name! globalId",
	task => "(pouInstance)* $end | name! single interval priority! globalId",
	pouInstance => "$end | name! typeName! globalId",
	accessVars => "(accessVariable)* $end |",
	accessVariable => "type $end | alias! instancePathAndName! direction",
	configVars => "(configVariable)* $end |",
	configVariable => "type initialValue:value? $end | instancePathAndName! address",
	type => "$type |",
	(map { $_ => '|' } @elementary),
	string => '| length', wstring => '| length',
	array => '(dimension:range)+ baseType:type |',
	derived => 'addData? | name!',
	enum => 'values baseType:type? |',
	values => '(value:enumerated)* |',
	enumerated => '| name! value',
	struct => "(variable:declared)* $end |",
	subrangeSigned => 'range baseType:type |', subrangeUnsigned => 'range baseType:type |',
	range => '| lower! upper!',
	pointer => 'baseType:type |',
	value => '(simpleValue|arrayValue|structValue) |',
	simpleValue => '| value',
	arrayValue => '(value:repeated)* |',
	repeated => '(simpleValue|arrayValue|structValue) | repetitionValue',
	structValue => '(value:member)* |',
	member => '(simpleValue|arrayValue|structValue) | member!',
	text => '(p:characters) |',
	characters => '= |',
	addData => '(data)* |',
	data => '* | name! handleUnknown!',
	# drawings
	position => '| x! y!',
	connection => '(position)* addData? | globalId refLocalId! formalParameter',
	in => 'relPosition:point? ((connection)+|expression:characters)? addData? | globalId',
	out => 'relPosition:point? expression:characters? addData? | globalId',
	named_out => 'relPosition:point? expression:characters? addData? | globalId formalParameter!',
	comment => "position content:text $end | localId! height! width! globalId",
	error => "position content:text $end | localId! height! width! globalId",
	connector => "position connectionPointIn:in? $end | name! localId! height width globalId",
	continuation => "position connectionPointOut:out? $end | name! localId! height width globalId",
	actionBlock => "position connectionPointIn:in? (action:step_action)* $end | localId! negated $drawn",
	step_action => "relPosition:point reference? inline:body? connectionPointOut:out? $end | localId! qualifier $drawn duration indicator",
	reference => '| name!',
	block => "position inputVariables inOutVariables outputVariables $end | localId! typeName! instanceName $drawn",
	inputVariables => '(variable:in_pin)* |', inOutVariables => '(variable:both_pin)* |', outputVariables => '(variable:out_pin)* |',
	in_pin => "connectionPointIn:in addData? documentation:text? | formalParameter! $modified hidden",
	both_pin => "connectionPointIn:in? connectionPointOut:out? addData? documentation:text? | formalParameter! $modified hidden",
	out_pin => "connectionPointOut:out? addData? documentation:text? | formalParameter! $modified hidden",
	inVariable => "position connectionPointOut:out? expression:characters $end | localId! $drawn $modified",
	outVariable => "position connectionPointIn:in? expression:characters $end | localId! $drawn $modified",
	inOutVariable => "position connectionPointIn:in? connectionPointOut:out? expression:characters $end | localId! $drawn negatedIn edgeIn storageIn negatedOut edgeOut storageOut",
	label => "position $end | localId! label! $drawn",
	jump => "position connectionPointIn:in? $end | localId! label! $drawn",
	return => "position connectionPointIn:in? $end | localId! $drawn",
	leftPowerRail => "position (connectionPointOut:named_out)* $end | localId! $drawn",
	rightPowerRail => "position (connectionPointIn:in)* $end | localId! $drawn",
	contact => "position connectionPointIn:in? connectionPointOut:out? variable:characters $end | localId! $drawn $modified",
	coil => "position connectionPointIn:in? connectionPointOut:out? variable:characters $end | localId! $drawn $modified",
	step => "position connectionPointIn:in? connectionPointOut:named_out? connectionPointOutAction:named_out? $end | localId! name! initialStep negated $drawn",
	macroStep => "position connectionPointIn:in? connectionPointOut:out? body? $end | localId! name $drawn",
	jumpStep => "position connectionPointIn:in? $end | localId! targetName! $drawn",
	transition => "position connectionPointIn:in? connectionPointOut:out? condition? $end | localId! priority $drawn",
	condition => '(reference|connectionPointIn:in|inline) | negated',
	inline => "(IL:text|ST:text|FBD|LD|SFC) $end | name!",
	selectionDivergence => "position connectionPointIn:in? (connectionPointOut:named_out)* $end | localId! height width globalId",
	selectionConvergence => "position (connectionPointIn:in)* connectionPointOut:out? $end | localId! height width globalId",
	simultaneousDivergence => "position connectionPointIn:in? (connectionPointOut:named_out)* $end | localId! height width name globalId",
	simultaneousConvergence => "position (connectionPointIn:in)* connectionPointOut:out? $end | localId! height width globalId",
);

# What values some attributes have.
my $number = qr/^-?\d+(?:\.\d+)?$/;
my %values = (
	pouType => qr/^(?:function|functionBlock|program)$/, edge => qr/^(?:none|rising|falling)$/, storage => qr/^(?:none|set|reset)$/,
	qualifier => qr/^(?:P1|N|P0|R|S|L|D|P|DS|DL|SD|SL)$/, direction => qr/^(?:readOnly|readWrite)$/,
	handleUnknown => qr/^(?:preserve|discard|implementation)$/, priority => qr/^\d+$/,
	(map { $_ => $number } qw(x y height width)), (map { $_ => qr/^\d+$/ } qw(localId refLocalId executionOrderId)),
	(map { $_ => qr/^(?:true|false|0|1)$/ } qw(negated hidden initialStep constant retain nonretain)),
	creationDateTime => qr/^\d{4}-\d\d-\d\dT\d\d:\d\d:\d\d$/,
);

# From the table: what children may follow one another, and of which kind each is.
my (%children, %kind_of, %attributes);
for my $kind (keys %kinds) {
	my ($content, $attributes) = $kinds{$kind} =~ /^(.*)\|([^|)]*)$/s or die "$kind: no |";
	while ($content =~ /(\w+)(?::(\w+))?/g) { $kind_of{$kind}{$1} = $2 // $1 }
	$content =~ s/(\w+):\w+/$1/g;
	$content =~ s/(\w+)/(?:$1,)/g;
	$content =~ s/\s+//g;
	$children{$kind} = $content =~ /^[*=]/ ? $content : qr/^$content$/;
	$attributes{$kind} = { map { /^(\w+)(!?)$/ ? ($1 => $2 ? 1 : 0) : () } split ' ', $attributes };
}

# A tree of elements; the text of our own export needs no more of XML than this.
sub tree {
	my ($text) = @_;
	my $root = { children => [], text => '', attributes => {} };
	my @open = ($root);
	$text =~ s/^<\?xml[^>]*\?>//;
	while ($text =~ /\G(?:<!\[CDATA\[(.*?)\]\]>|<\/([\w:]+)>|<([\w:]+)((?:\s+[\w:]+="[^"<]*")*)\s*(\/?)>|([^<]+))/gcs) {
		if (defined $1 || defined $6) { $open[-1]{text} .= $1 // $6; next }
		if (defined $2) { return undef if @open < 2 || $open[-1]{tag} ne $2; pop @open; next }
		my ($tag, $attributes, $empty) = ($3, $4, $5);
		my $node = { tag => $tag, name => $tag =~ s/^\w+://r, children => [], text => '', attributes => { $attributes =~ /([\w:]+)="([^"]*)"/g } };
		push @{$open[-1]{children}}, $node;
		push @open, $node if !$empty;
	}
	return @open == 1 && (pos($text) // 0) == length $text && @{$root->{children}} == 1 ? $root->{children}[0] : undef;
}

my @wrong;
sub check {
	my ($node, $kind, $path) = @_;
	my $here = "$path/$node->{name}" . (defined $node->{attributes}{name} ? "[$node->{attributes}{name}]" : '');
	my $names = join '', map { "$_->{name}," } @{$node->{children}};
	if (!exists $children{$kind}) { push @wrong, "$here: nobody knows the kind $kind"; return }
	for my $name (keys %{$node->{attributes}}) {
		next if $name =~ /^xmlns/;
		push @wrong, "$here: has no attribute $name" if !exists $attributes{$kind}{$name};
		push @wrong, "$here: $name is \"$node->{attributes}{$name}\"" if $values{$name} && $node->{attributes}{$name} !~ $values{$name};
	}
	push @wrong, map { "$here: needs the attribute $_" } grep { $attributes{$kind}{$_} && !defined $node->{attributes}{$_} } sort keys %{$attributes{$kind}};
	return if $children{$kind} eq '*';
	push @wrong, "$here: text between elements" if $children{$kind} ne '=' && $node->{text} =~ /\S/;
	push @wrong, "$here: has elements" if $children{$kind} eq '=' && $names ne '';
	return if $children{$kind} eq '=';
	push @wrong, "$here: its elements are $names" if $names !~ $children{$kind};
	check($_, $kind_of{$kind}{$_->{name}}, $here) for grep { $kind_of{$kind}{$_->{name}} } @{$node->{children}};
	references($node, $here) if $node->{name} =~ /^(?:FBD|LD|SFC)$/;
}

sub below { my ($node) = @_; return map { ($_, $_->{name} eq 'body' ? () : below($_)) } @{$node->{children}} }

# A body and its elements; a macro-step has a body of its own.
sub references {
	my ($body, $path) = @_;
	my %element;
	for my $e (@{$body->{children}}) {
		my $id = $e->{attributes}{localId} // next;
		push @wrong, "$path: localId $id stands twice" if $element{$id};
		$element{$id} = $e;
	}
	for my $e (below($body)) {
		next if $e->{name} ne 'connection';
		my ($id, $pin) = @{$e->{attributes}}{qw(refLocalId formalParameter)};
		my $from = $element{$id // ''};
		if (!$from) { push @wrong, "$path: nothing has the localId " . ($id // ''); next }
		next if !defined $pin || $from->{name} ne 'block';
		my ($outputs) = grep { $_->{name} eq 'outputVariables' } @{$from->{children}};
		push @wrong, "$path: $from->{attributes}{typeName} has no output $pin"
			if !grep { ($_->{attributes}{formalParameter} // '') eq $pin } @{$outputs->{children}};
	}
}

# What is wrong with it, a line each; '': nothing.
sub wrong {
	my ($text) = @_;
	my $root = tree($text);
	@wrong = ();
	return 'no XML' if !$root;
	return "begins with $root->{name}" if $root->{name} ne 'project';
	push @wrong, 'the namespace is another one' if ($root->{attributes}{xmlns} // '') ne 'http://www.plcopen.org/xml/tc6_0201';
	check($root, 'project', '');
	return join "\n", @wrong;
}
1;
