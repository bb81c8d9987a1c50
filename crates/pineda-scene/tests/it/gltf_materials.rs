use pineda_scene::{
    Anisotropy, Clearcoat, Filter, Format, Iridescence, Limits, Material, Model, NoFiles, Pose, Sampler, Sheen,
    Specular, SpecularGlossiness, TextureRef, Transmission, Volume, Wrap,
};
use serde_json::{Value, json};

use crate::gltf_file::{File, push};
use crate::images::{data_uri, pixel, textured};
use crate::only;

/// The one material of a square with it; textures 0 to 3 are there.
fn material(json: Value) -> Material {
    let mut file = textured(json!({"uri": data_uri(&pixel())}));
    file.json["textures"] = json!([{"source": 0}, {"source": 0}, {"source": 0}, {"source": 0}]);
    file.json["materials"] = json!([json]);
    let mut loaded = file.loaded();
    assert!(loaded.notes.is_empty(), "{:?}", loaded.notes);
    loaded.scene.materials.remove(0)
}

fn extension(name: &str, json: Value) -> Material {
    material(json!({"extensions": {name: json}}))
}

fn texture(number: usize) -> Option<TextureRef> {
    Some(TextureRef::new(number))
}

#[test]
fn gltf_material_of_defaults() {
    assert_eq!(material(json!({})), Material::gltf());
    // An extension without fields has its own defaults.
    let all = material(json!({"extensions": {
        "KHR_materials_unlit": {}, "KHR_materials_emissive_strength": {}, "KHR_materials_ior": {},
        "KHR_materials_specular": {}, "KHR_materials_clearcoat": {}, "KHR_materials_sheen": {},
        "KHR_materials_transmission": {}, "KHR_materials_volume": {}, "KHR_materials_iridescence": {},
        "KHR_materials_anisotropy": {}, "KHR_materials_pbrSpecularGlossiness": {},
    }}));
    let expected = Material {
        unlit: true,
        specular: Some(Specular::default()),
        clearcoat: Some(Clearcoat::default()),
        sheen: Some(Sheen::default()),
        transmission: Some(Transmission::default()),
        volume: Some(Volume::default()),
        iridescence: Some(Iridescence::default()),
        anisotropy: Some(Anisotropy::default()),
        specular_glossiness: Some(SpecularGlossiness::default()),
        ..Material::gltf()
    };
    assert_eq!(all, expected);
}

#[test]
fn gltf_material_of_the_core() {
    // Texture numbers are in the order of the file's: 0 emissive, 1 normal, 2 metallic, 3 base.
    let material = material(json!({
        "pbrMetallicRoughness": {
            "baseColorFactor": [0.1, 0.2, 0.3, 0.4], "baseColorTexture": {"index": 3},
            "metallicFactor": 0.5, "roughnessFactor": 0.25, "metallicRoughnessTexture": {"index": 2},
        },
        "normalTexture": {"index": 1, "scale": -2.0},
        "occlusionTexture": {"index": 2, "strength": 0.75},
        "emissiveTexture": {"index": 0, "texCoord": 1},
        "emissiveFactor": [1.0, 0.5, 0.25],
        "doubleSided": true,
    }));
    let expected = Material {
        base_color_factor: [0.1, 0.2, 0.3, 0.4],
        base_color_texture: texture(3),
        metallic_factor: 0.5,
        roughness_factor: 0.25,
        metallic_roughness_texture: texture(2),
        normal_texture: texture(1),
        normal_scale: -2.0,
        occlusion_texture: texture(2),
        occlusion_strength: 0.75,
        emissive_factor: [1.0, 0.5, 0.25],
        emissive_texture: Some(TextureRef { uv_set: 1, ..TextureRef::new(0) }),
        double_sided: true,
        ..Material::gltf()
    };
    assert_eq!(material, expected);
    assert_eq!(material.textures().count(), 5);
}

#[test]
fn gltf_material_extensions() {
    let material = extension("KHR_materials_emissive_strength", json!({"emissiveStrength": 5.0}));
    assert_eq!(material.emissive_strength, 5.0);
    assert_eq!(extension("KHR_materials_ior", json!({"ior": 1.33})).ior, 1.33);
    let specular = json!({"specularFactor": 0.5, "specularTexture": {"index": 0}, "specularColorFactor": [2, 1, 0], "specularColorTexture": {"index": 1}});
    assert_eq!(
        extension("KHR_materials_specular", specular).specular,
        Some(Specular { factor: 0.5, texture: texture(0), color_factor: [2.0, 1.0, 0.0], color_texture: texture(1) })
    );
    let clearcoat = json!({"clearcoatFactor": 1, "clearcoatTexture": {"index": 0}, "clearcoatRoughnessFactor": 0.5, "clearcoatRoughnessTexture": {"index": 1}, "clearcoatNormalTexture": {"index": 2, "scale": 3}});
    assert_eq!(
        extension("KHR_materials_clearcoat", clearcoat).clearcoat,
        Some(Clearcoat {
            factor: 1.0,
            texture: texture(0),
            roughness_factor: 0.5,
            roughness_texture: texture(1),
            normal_texture: texture(2),
            normal_scale: 3.0
        })
    );
    let sheen = json!({"sheenColorFactor": [1, 0.5, 0], "sheenColorTexture": {"index": 0}, "sheenRoughnessFactor": 0.5, "sheenRoughnessTexture": {"index": 1}});
    assert_eq!(
        extension("KHR_materials_sheen", sheen).sheen,
        Some(Sheen {
            color_factor: [1.0, 0.5, 0.0],
            color_texture: texture(0),
            roughness_factor: 0.5,
            roughness_texture: texture(1)
        })
    );
    let transmission = json!({"transmissionFactor": 0.9, "transmissionTexture": {"index": 0}});
    assert_eq!(
        extension("KHR_materials_transmission", transmission).transmission,
        Some(Transmission { factor: 0.9, texture: texture(0) })
    );
    let volume = json!({"thicknessFactor": 2, "thicknessTexture": {"index": 0}, "attenuationDistance": 0.5, "attenuationColor": [1, 0.5, 0]});
    assert_eq!(
        extension("KHR_materials_volume", volume).volume,
        Some(Volume {
            thickness_factor: 2.0,
            thickness_texture: texture(0),
            attenuation_distance: 0.5,
            attenuation_color: [1.0, 0.5, 0.0]
        })
    );
    let iridescence = json!({"iridescenceFactor": 1, "iridescenceTexture": {"index": 0}, "iridescenceIor": 1.8, "iridescenceThicknessMinimum": 200, "iridescenceThicknessMaximum": 600, "iridescenceThicknessTexture": {"index": 1}});
    assert_eq!(
        extension("KHR_materials_iridescence", iridescence).iridescence,
        Some(Iridescence {
            factor: 1.0,
            texture: texture(0),
            ior: 1.8,
            thickness_minimum: 200.0,
            thickness_maximum: 600.0,
            thickness_texture: texture(1)
        })
    );
    let anisotropy = json!({"anisotropyStrength": 0.5, "anisotropyRotation": 1.5, "anisotropyTexture": {"index": 0}});
    assert_eq!(
        extension("KHR_materials_anisotropy", anisotropy).anisotropy,
        Some(Anisotropy { strength: 0.5, rotation: 1.5, texture: texture(0) })
    );
    let glossiness = json!({"diffuseFactor": [1, 0, 0, 0.5], "diffuseTexture": {"index": 0}, "specularFactor": [0, 1, 0], "glossinessFactor": 0.5, "specularGlossinessTexture": {"index": 1}});
    assert_eq!(
        extension("KHR_materials_pbrSpecularGlossiness", glossiness).specular_glossiness,
        Some(SpecularGlossiness {
            diffuse_factor: [1.0, 0.0, 0.0, 0.5],
            diffuse_texture: texture(0),
            specular_factor: [0.0, 1.0, 0.0],
            glossiness_factor: 0.5,
            specular_glossiness_texture: texture(1)
        })
    );
}

/// What would be infinite or out of its range does not get far.
#[test]
fn gltf_material_numbers_out_of_range() {
    let material = material(json!({
        "pbrMetallicRoughness": {"baseColorFactor": [1e60, 0, 0, 1], "metallicFactor": 7, "roughnessFactor": -1},
        "emissiveFactor": [1, 2, 1e60],
        "extensions": {"KHR_materials_ior": {"ior": 1e60}, "KHR_materials_volume": {"attenuationDistance": 0}},
    }));
    assert_eq!(material.base_color_factor, [1.0; 4]);
    assert_eq!((material.metallic_factor, material.roughness_factor), (1.0, 0.0));
    assert_eq!((material.emissive_factor, material.ior), ([0.0; 3], 1.5));
    assert_eq!(material.volume.unwrap().attenuation_distance, f32::INFINITY);
    let clear = json!({"attenuationDistance": f64::MAX});
    assert_eq!(extension("KHR_materials_volume", clear).volume.unwrap().attenuation_distance, f32::INFINITY);
}

#[test]
fn gltf_texture_transforms() {
    let of = |transform: Value| {
        let info = json!({"index": 0, "texCoord": 2, "extensions": {"KHR_texture_transform": transform}});
        material(json!({"emissiveTexture": info})).emissive_texture.unwrap()
    };
    assert!(of(json!({})).is_identity());
    assert_eq!(of(json!({})).uv_set, 2);
    assert_eq!(of(json!({"texCoord": 1})).uv_set, 1);
    assert_eq!(of(json!({"offset": [0.5, 0.25]})).transform, [[1.0, 0.0, 0.5], [0.0, 1.0, 0.25]]);
    assert_eq!(of(json!({"scale": [2, 3]})).transform, [[2.0, 0.0, 0.0], [0.0, 3.0, 0.0]]);
    assert!(of(json!({"rotation": 1e300, "scale": [1e300, 1]})).transform[0][0].is_finite());
    // Scaled, then turned, then moved. Counter-clockwise as one sees it, with v going down: right becomes up.
    let [[a, b, c], [d, e, f]] =
        of(json!({"offset": [10, 20], "rotation": std::f64::consts::FRAC_PI_2, "scale": [2, 3]})).transform;
    assert_eq!((b, c, d, f), (3.0, 10.0, -2.0, 20.0));
    assert!(a.abs() < 1e-15 && e.abs() < 1e-15);
}

#[test]
fn gltf_samplers() {
    let of = |sampler: Value| {
        let mut file = textured(json!({"uri": data_uri(&pixel())}));
        file.json["samplers"] = json!([sampler]);
        file.json["textures"][0]["sampler"] = json!(0);
        file.loaded().scene.textures[0].sampler
    };
    use Filter::{Linear, Nearest};
    assert_eq!(of(json!({})), Sampler::default());
    assert_eq!(of(json!({"magFilter": 9728})).mag_filter, Nearest);
    assert_eq!(of(json!({"magFilter": 9729})).mag_filter, Linear);
    for (code, min, mip) in [
        (9728, Nearest, None),
        (9729, Linear, None),
        (9984, Nearest, Some(Nearest)),
        (9985, Linear, Some(Nearest)),
        (9986, Nearest, Some(Linear)),
        (9987, Linear, Some(Linear)),
        (1, Linear, Some(Linear)),
    ] {
        let sampler = of(json!({"minFilter": code}));
        assert_eq!((sampler.min_filter, sampler.mip_filter), (min, mip), "{code}");
    }
    for (code, wrap) in [(33071, Wrap::ClampToEdge), (33648, Wrap::MirroredRepeat), (10497, Wrap::Repeat)] {
        assert_eq!(of(json!({"wrapS": code})), Sampler { wrap_s: wrap, ..Sampler::default() });
        assert_eq!(of(json!({"wrapT": code})), Sampler { wrap_t: wrap, ..Sampler::default() });
    }
}

#[test]
fn gltf_texture_coordinates_of_all_types_and_sets() {
    let mut file = textured(json!({"uri": data_uri(&pixel())}));
    let second = file.accessor(&[0, 0, 255, 0, 255, 51, 0, 102], 5121, "VEC2", 4);
    file.json["accessors"][second]["normalized"] = json!(true);
    let shorts: Vec<u8> = [0u16, 65535, 13107, 0, 0, 0, 0, 0].iter().flat_map(|n| n.to_le_bytes()).collect();
    let fourth = file.accessor(&shorts, 5123, "VEC2", 4);
    file.json["accessors"][fourth]["normalized"] = json!(true);
    file.attribute("TEXCOORD_1", second);
    file.attribute("TEXCOORD_3", fourth);
    // Only the first set, unless somebody looks at the others.
    let expected = vec![[0.0, 1.0], [1.0, 1.0], [1.0, 0.0], [0.0, 0.0]];
    assert_eq!(only(&file.loaded()).uvs, std::slice::from_ref(&expected));
    file.json["materials"][0]["emissiveTexture"] = json!({"index": 0, "texCoord": 3});
    let loaded = file.loaded();
    let uvs = &only(&loaded).uvs;
    assert_eq!(uvs.len(), 4);
    assert_eq!(uvs[1], [[0.0, 0.0], [1.0, 0.0], [1.0, 0.2], [0.0, 0.4]]);
    assert_eq!(uvs[2], [[0.0; 2]; 4], "a set that is left out");
    assert_eq!(uvs[3][..2], [[0.0, 1.0], [0.2, 0.0]]);
    // A set that nobody could count to.
    file.json["materials"][0]["emissiveTexture"] = json!({"index": 0, "texCoord": u64::MAX});
    assert_eq!(file.loaded().scene.objects[0].uvs.len(), 4);
    file.buffer[0..4].copy_from_slice(&[0; 4]);
    let at = file.json["bufferViews"][2]["byteOffset"].as_u64().unwrap() as usize;
    file.buffer[at..at + 4].copy_from_slice(&f32::NAN.to_le_bytes());
    let loaded = file.loaded();
    assert_eq!(only(&loaded).uvs[0][0], [0.0; 2]);
    assert_eq!(loaded.notes, ["1 texture coordinate replaced by 0: infinite or not a number"]);
}

#[test]
fn gltf_tangents() {
    let tangents = |scale: [i32; 3], w: f32| {
        let mut file = File::triangle();
        let normals = file.floats("VEC3", &[0.0, 0.0, 1.0].repeat(3));
        let tangents = file.floats("VEC4", &[3.0, 4.0, 0.0, w].repeat(3));
        file.attribute("NORMAL", normals);
        file.attribute("TANGENT", tangents);
        file.node()["scale"] = json!(scale);
        only(&file.loaded()).tangents.clone()
    };
    assert_eq!(tangents([1, 1, 1], 1.0), [[0.6, 0.8, 0.0, 1.0]; 3]);
    assert_eq!(tangents([4, 3, 1], -1.0), [[0.5f32.sqrt(), 0.5f32.sqrt(), 0.0, -1.0]; 3]);
    // The mirror image's bitangent is the mirrored bitangent: cross(+z, (-0.6, 0.8)) is (-0.8, -0.6), that of the
    // original (-0.8, 0.6) mirrored is (0.8, 0.6).
    assert_eq!(tangents([-1, 1, 1], 1.0), [[-0.6, 0.8, 0.0, -1.0]; 3]);
    assert!(only(&File::triangle().loaded()).tangents.is_empty());
}

#[test]
fn gltf_variants() {
    let mut file = textured(json!({"uri": "gone.png"}));
    push(&mut file.json["materials"], json!({"name": "blue"}));
    push(&mut file.json["materials"], json!({"name": "green"}));
    file.json["extensions"] =
        json!({"KHR_materials_variants": {"variants": [{"name": "sea"}, {"name": "wood"}, {"name": "none"}]}});
    file.primitive()["extensions"] = json!({"KHR_materials_variants": {"mappings": [
        {"material": 1, "variants": [0]}, {"material": 2, "variants": [9, 1]},
    ]}});
    file.json["extensionsUsed"] = json!(["KHR_materials_variants"]);
    let model = Model::from_bytes(file.text().as_bytes(), Format::Gltf, &NoFiles, &Limits::default()).unwrap();
    let names: Vec<_> = model.contents().variants.iter().map(|name| name.to_string()).collect();
    assert_eq!(names, ["sea", "wood", "none"]);
    let of = |variant: Option<&str>| {
        let loaded = model.scene(&Pose { variant: variant.map(Into::into), ..Pose::default() }).unwrap();
        // Only the first material has the image that is not there.
        assert_eq!(loaded.notes.len(), usize::from(only(&loaded).material == 0));
        only(&loaded).material
    };
    assert_eq!([of(None), of(Some("sea")), of(Some("wood")), of(Some("none")), of(Some("1"))], [0, 1, 2, 0, 2]);
    let error = model.scene(&Pose { variant: Some("sky".into()), ..Pose::default() }).unwrap_err().to_string();
    assert_eq!(error, "has no variant 'sky': it has 0 'sea', 1 'wood', 2 'none'");
}

#[test]
fn gltf_poses_without_textures_decode_nothing() {
    let file = textured(json!({"uri": "gone.png"}));
    let model = Model::from_bytes(file.text().as_bytes(), Format::Gltf, &NoFiles, &Limits::default()).unwrap();
    let loaded = model.scene(&Pose { without_textures: true, ..Pose::default() }).unwrap();
    assert!(loaded.notes.is_empty() && loaded.scene.textures.is_empty());
    assert_eq!(loaded.scene.materials[0].base_color_texture, None);
}
