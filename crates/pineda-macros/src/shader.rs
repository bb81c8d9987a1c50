//! `#[shader]`: inlines what a SIMD level's code must contain.

use proc_macro2::{Span, TokenStream};
use quote::ToTokens;
use syn::visit_mut::{self, VisitMut};
use syn::{
    Attribute, Error, Expr, GenericParam, ImplItem, ImplItemFn, Item, ItemFn, ItemImpl, Local, Path, ReturnType,
    TraitItemFn, parse_quote,
};

pub(crate) fn expand(arguments: TokenStream, item: TokenStream) -> Result<TokenStream, Error> {
    if !arguments.is_empty() {
        return Err(Error::new_spanned(arguments, "#[shader] takes no arguments"));
    }
    let mut item: Item = syn::parse2(item)?;
    match &item {
        Item::Fn(_) | Item::Impl(_) | Item::Trait(_) => {}
        Item::Mod(module) if module.content.is_some() => {}
        _ => {
            return Err(Error::new(
                Span::call_site(),
                "#[shader] goes above an `impl`, a `fn`, a `trait`, or a `mod` with its contents in braces",
            ));
        }
    }
    Inliner.visit_item_mut(&mut item);
    Ok(item.into_token_stream())
}

/// Adds the attribute to every function inside, and to the closures where stable Rust allows an attribute.
struct Inliner;

impl VisitMut for Inliner {
    fn visit_item_fn_mut(&mut self, function: &mut ItemFn) {
        inline(&mut function.attrs);
        visit_mut::visit_item_fn_mut(self, function);
    }

    fn visit_impl_item_fn_mut(&mut self, function: &mut ImplItemFn) {
        inline(&mut function.attrs);
        visit_mut::visit_impl_item_fn_mut(self, function);
    }

    fn visit_trait_item_fn_mut(&mut self, function: &mut TraitItemFn) {
        if function.default.is_some() {
            inline(&mut function.attrs);
        }
        visit_mut::visit_trait_item_fn_mut(self, function);
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
