// One block (line) of SINUMERIK. Tokens come from frontend/sinumerik/token_source; their kinds stand in
// frontend/sinumerik/token_kinds.def in this order. Structures over several lines are joined afterwards.
parser grammar SinumerikParser;

tokens {
  Skip, BlockNumber, MainNumber, Label,
  Code, AxisValue, Axis, AxisAt, AddressValue, Address, PassesValue, Passes, SubName, Name,
  Cell, CellAt, System, Number, Text, Boolean, Function, Mode,
  Type, StringType, Attribute, Def, DefScope, DefFlag, DefValue, LowerLimit, UpperLimit,
  Define, As, Proc, Extern, Var, Set, Rep,
  If, Else, EndIf, While, EndWhile, For, To, EndFor, Loop, EndLoop, Repeat, RepeatBlock, Until,
  Goto, GotoStart, Case, Of, Default,
  Call, BlockRange, PathCall, Path, ExternalCall, ModalCall, Return,
  Message, SetAlarm, PreprocessStop, Workpiece, InertCall, ComputedG, ComputedM,
  Equals, EqualTo, NotEqual, Less, LessEqual, Greater, GreaterEqual,
  Plus, Minus, Star, Slash, DivideInteger, Modulo, Not, BitNot, BitAnd, BitXor, BitOr, And, Xor, Or, Concat,
  LeftParen, RightParen, LeftBracket, RightBracket, Comma, Colon, Refused
}

block : Skip? (BlockNumber | MainNumber)? Label? statement? EOF ;

statement
  : definition
  | structure
  | call
  | item+
  ;

// Words that may stand beside each other.
item
  : Code                                                          # codeItem
  | AxisValue                                                     # axisValueItem
  | AddressValue                                                  # addressValueItem
  | Axis Equals value                                             # axisItem
  | AxisAt LeftBracket expression RightBracket Equals value       # axisAtItem
  | Address (LeftBracket expression RightBracket)? Equals value   # addressItem
  | ComputedG Equals expression                                   # computedGItem
  | ComputedM (LeftBracket expression RightBracket)? Equals value # computedMItem
  | place Equals assigned                                         # assignItem
  | jump                                                          # jumpItem
  | If expression jump                                            # conditionalJumpItem
  | Case expression Of caseArm+ (Default jump)?                   # caseItem
  | Message LeftParen arguments RightParen                        # messageItem
  | SetAlarm LeftParen expression (Comma expression)? RightParen  # alarmItem
  | PreprocessStop (LeftParen RightParen)?                        # preprocessStopItem
  | Workpiece LeftParen arguments RightParen                      # workpieceItem
  | InertCall (LeftParen arguments RightParen)?                   # inertCallItem
  | Attribute                                                     # attributeItem
  | Return (LeftParen arguments RightParen)?                      # returnItem
  ;

value : expression | Mode LeftParen expression RightParen ;

assigned
  : Set LeftParen listItem (Comma listItem)* RightParen           # setAssigned
  | Rep LeftParen expression (Comma expression)? RightParen       # repAssigned
  | LeftParen listItem (Comma listItem)+ RightParen               # listAssigned
  | expression                                                    # plainAssigned
  ;
listItem : expression? ;

jump : Goto target | GotoStart ;
target
  : Name            # nameTarget
  | SubName         # subNameTarget
  | BlockNumber     # numberTarget
  | MainNumber      # mainNumberTarget
  | expression      # expressionTarget
  ;
caseArm : expression jump ;

// Alone in their block.
structure
  : If expression
  | Else
  | EndIf
  | While expression
  | EndWhile
  | For place Equals expression To expression
  | EndFor
  | Loop
  | EndLoop
  | Repeat
  | Until expression
  ;

call
  : callee (LeftParen arguments RightParen)? passes?                                     # nameCall
  | ModalCall (callee (LeftParen arguments RightParen)?)?                                # modalCall
  | Call (callee LeftParen arguments RightParen | SubName | expression)? (BlockRange target To target)? passes?  # textCall
  | PathCall Path (LeftParen arguments RightParen)? passes?                              # pathCall
  | ExternalCall expression                                                              # externalCall
  | Repeat target target? passes?                                                        # repeatPart
  | RepeatBlock target passes?                                                           # repeatBlock
  ;
callee : Name | SubName ;
passes : PassesValue | Passes Equals expression ;
arguments : argument (Comma argument)* ;
argument : expression? ;

definition
  : Def DefScope? defAttribute* type defAttribute* declarator (Comma declarator)*        # defDefinition
  | Proc callee (LeftParen (parameter (Comma parameter)*)? RightParen)? Attribute*       # procDefinition
  | Extern callee (LeftParen (externParameter (Comma externParameter)*)? RightParen)?    # externDefinition
  | Define . As .+?                                                                      # macroDefinition
  ;
type : Type | StringType LeftBracket expression RightBracket ;
defAttribute
  : DefFlag
  | DefValue expression
  | LowerLimit expression
  | UpperLimit expression
  ;
declarator : Name dimensions? (Equals assigned)? ;
dimensions : LeftBracket dimension (Comma dimension)* RightBracket ;
dimension : expression? ;
parameter : Var? type Name dimensions? (Equals expression)? ;
externParameter : Var? (Type | StringType (LeftBracket expression RightBracket)?) dimensions? ;

place
  : Name (LeftBracket expression (Comma expression)* RightBracket)?                      # namePlace
  | Cell                                                                                 # cellPlace
  | CellAt LeftBracket expression RightBracket                                           # cellAtPlace
  | System (LeftBracket expression (Comma expression)* RightBracket)?                    # systemPlace
  ;

// Card 4.1, tightest first. Comparisons bind weakest, below AND and OR.
expression
  : primary                                                             # primaryExpression
  | op=(Not | BitNot | Minus | Plus) expression                   # unaryExpression
  | expression op=(Star | Slash | DivideInteger | Modulo) expression  # binaryExpression
  | expression op=(Plus | Minus) expression                       # binaryExpression
  | expression op=BitAnd expression                               # binaryExpression
  | expression op=BitXor expression                               # binaryExpression
  | expression op=BitOr expression                                # binaryExpression
  | expression op=And expression                                  # binaryExpression
  | expression op=Xor expression                                  # binaryExpression
  | expression op=Or expression                                   # binaryExpression
  | op=Concat expression                                          # unaryExpression
  | expression op=Concat expression                               # binaryExpression
  | expression op=(EqualTo | NotEqual | Less | LessEqual | Greater | GreaterEqual) expression  # binaryExpression
  ;

primary
  : Number                                                              # numberPrimary
  | Text                                                                # textPrimary
  | Boolean                                                             # booleanPrimary
  | place                                                               # placePrimary
  | Axis                                                                # axisPrimary
  | AxisValue                                                           # axisPrimary
  | Function LeftParen expression (Comma expression)* RightParen        # functionPrimary
  | LeftParen expression RightParen                                     # groupPrimary
  ;
