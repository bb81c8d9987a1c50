//! `#[shader]`: inlines what a SIMD level's code must contain, or makes a function of its own of it that has the level's instructions.

use proc_macro2::{Ident, Span, TokenStream};
use quote::ToTokens;
use syn::parse::{Parse, ParseStream};
use syn::visit_mut::{self, VisitMut};
use syn::{
    Attribute, Block, Error, Expr, FnArg, GenericParam, ImplItem, ImplItemFn, Item, ItemFn, ItemImpl, Local, Meta, Pat,
    Path, ReturnType, Signature, TraitItemFn, parenthesized, parse_quote,
};

pub(crate) fn expand(arguments: TokenStream, item: TokenStream) -> Result<TokenStream, Error> {
    let mut item: Item = syn::parse2(item)?;
    match &mut item {
        Item::Fn(function) if !arguments.is_empty() => function.attrs.push(parse_quote!(#[shader(#arguments)])),
        _ if !arguments.is_empty() => {
            return Err(Error::new_spanned(arguments, "#[shader] takes arguments above a `fn` only: `apart`"));
        }
        Item::Fn(_) | Item::Impl(_) | Item::Trait(_) => {}
        Item::Mod(module) if module.content.is_some() => {}
        _ => {
            return Err(Error::new(
                Span::call_site(),
                "#[shader] goes above an `impl`, a `fn`, a `trait`, or a `mod` with its contents in braces",
            ));
        }
    }
    let mut inliner = Inliner { problem: None };
    inliner.visit_item_mut(&mut item);
    inliner.problem.map_or_else(|| Ok(item.into_token_stream()), Err)
}

/// Adds the attribute to every function inside, and to the closures where stable Rust allows an attribute.
struct Inliner {
    /// The last one found.
    problem: Option<Error>,
}

impl Inliner {
    /// A function is inlined; one that is to be apart calls its body as a function at its lanes' level.
    fn function(&mut self, attributes: &mut Vec<Attribute>, signature: &Signature, body: &mut Block) {
        match attributes.iter().find_map(|attribute| lanes(attribute, signature)) {
            Some(Ok(lanes)) => *body = parse_quote!({ (#lanes).lanes().apart(#[inline(always)] || #body) }),
            Some(Err(problem)) => self.problem = Some(problem),
            None => {}
        }
        inline(attributes);
    }
}

/// What says at which width and level a function runs that is to be apart: what the attribute names, or else the first argument.
fn lanes(attribute: &Attribute, signature: &Signature) -> Option<Result<Expr, Error>> {
    let Meta::List(list) = &attribute.meta else { return None };
    if !ends_with(&list.path, "shader") {
        return None;
    }
    Some(list.parse_args().and_then(|Apart(lanes)| match (lanes, signature.inputs.first()) {
        (Some(lanes), _) => Ok(lanes),
        (None, Some(FnArg::Receiver(_))) => Ok(parse_quote!(self)),
        (None, Some(FnArg::Typed(argument))) if let Pat::Ident(name) = &*argument.pat => {
            let name = &name.ident;
            Ok(parse_quote!(#name))
        }
        _ => Err(Error::new_spanned(
            signature,
            "#[shader(apart)] asks the first argument for its lanes, and this one has no name; say what to ask: #[shader(apart(normal))]",
        )),
    }))
}

/// `apart`, or `apart(normal)`.
struct Apart(Option<Expr>);

impl Parse for Apart {
    fn parse(input: ParseStream<'_>) -> Result<Self, Error> {
        let word: Ident = input.parse()?;
        if word != "apart" {
            return Err(Error::new_spanned(word, "the only argument of #[shader] is `apart`"));
        }
        if input.is_empty() {
            return Ok(Self(None));
        }
        let lanes;
        parenthesized!(lanes in input);
        Ok(Self(Some(lanes.parse()?)))
    }
}

impl VisitMut for Inliner {
    fn visit_item_fn_mut(&mut self, function: &mut ItemFn) {
        visit_mut::visit_item_fn_mut(self, function);
        self.function(&mut function.attrs, &function.sig, &mut function.block);
    }

    fn visit_impl_item_fn_mut(&mut self, function: &mut ImplItemFn) {
        visit_mut::visit_impl_item_fn_mut(self, function);
        self.function(&mut function.attrs, &function.sig, &mut function.block);
    }

    fn visit_trait_item_fn_mut(&mut self, function: &mut TraitItemFn) {
        visit_mut::visit_trait_item_fn_mut(self, function);
        if let Some(body) = &mut function.default {
            self.function(&mut function.attrs, &function.sig, body);
        }
    }

    fn visit_item_impl_mut(&mut self, block: &mut ItemImpl) {
        block.attrs.retain(|attribute| !ends_with(attribute.path(), "shader"));
        if block.trait_.as_ref().is_some_and(|(path, _)| ends_with(path, "Shader")) {
            // The trait has this constant without a default, so that an impl without the attribute does not compile.
            block.items.push(parse_quote! {
                #[doc(hidden)]
                const ADD_THE_ATTRIBUTE_shader_TO_THIS_IMPL: () = ();
            });
            if let Some(output) = output(block) {
                block.items.push(output);
            }
        }
        visit_mut::visit_item_impl_mut(self, block);
    }

    fn visit_local_mut(&mut self, local: &mut Local) {
        visit_mut::visit_local_mut(self, local);
        if let Some(init) = &mut local.init
            && let Expr::Closure(closure) = &mut *init.expr
        {
            // Only an argument of a call may carry an attribute, so the closure goes through an identity function.
            inline(&mut closure.attrs);
            init.expr = parse_quote!(::pineda::__inlined(#closure));
        }
    }

    fn visit_expr_mut(&mut self, expression: &mut Expr) {
        let arguments = match expression {
            Expr::Call(call) => Some(&mut call.args),
            Expr::MethodCall(call) => Some(&mut call.args),
            _ => None,
        };
        for argument in arguments.into_iter().flatten() {
            if let Expr::Closure(closure) = argument {
                inline(&mut closure.attrs);
            }
        }
        visit_mut::visit_expr_mut(self, expression);
    }
}

/// `type Output<L>`, which is what the fragment stage says that it returns; `None` if it is there already, or the stage is not.
fn output(block: &ItemImpl) -> Option<ImplItem> {
    let is_output = |item: &ImplItem| matches!(item, ImplItem::Type(ty) if ty.ident == "Output");
    if block.items.iter().any(is_output) {
        return None;
    }
    let signature = block.items.iter().find_map(|item| match item {
        ImplItem::Fn(function) if function.sig.ident == "fragment" => Some(&function.sig),
        _ => None,
    })?;
    let width = signature.generics.params.iter().find_map(|parameter| match parameter {
        GenericParam::Type(width) => Some(&width.ident),
        _ => None,
    })?;
    Some(match &signature.output {
        ReturnType::Default => parse_quote!(type Output<#width: ::pineda::Lanes> = ();),
        ReturnType::Type(_, returned) => parse_quote!(type Output<#width: ::pineda::Lanes> = #returned;),
    })
}

/// `#[inline(always)]`, in place of whatever the item said about inlining and of `#[shader]` itself.
fn inline(attributes: &mut Vec<Attribute>) {
    attributes.retain(|attribute| !attribute.path().is_ident("inline") && !ends_with(attribute.path(), "shader"));
    attributes.push(parse_quote!(#[inline(always)]));
}

fn ends_with(path: &Path, name: &str) -> bool {
    path.segments.last().is_some_and(|segment| segment.ident == name)
}
